(** * The contracts say what the model says

    For each contract of [kernel.h] (translated into [Contracts.v]): where it may be asked, it holds
    of a result and a state afterwards if, and only if, they are the model's. So what Frama-C proves
    of the C text, and what [Statements.v] says of it, is one and the same. *)
From Coq Require Import ZArith NArith List.
From Refinement Require Import Semantics Kernel Statements.
From Refinement Require Contracts.
From GeneClocks Require Import Mark Clock Admission.
Import ListNotations.
Open Scope N_scope.

(** The state afterwards, as the model's answer has it: taken up, or as it was. *)
Definition leaves (answer : option clock) (n d : N) (result : bool) (n' d' : N) : Prop :=
  match answer with
  | Some c => result = true /\ n' = next c /\ d' = durable c
  | None => result = false /\ n' = n /\ d' = d
  end.

Definition gene_clocks_less_contract : Prop :=
  forall l a b result, Contracts.less_requires l a b ->
    Contracts.less_contract l a b result <-> result = mark_ltb a b.

Definition gene_clocks_equal_contract : Prop :=
  forall l a b result, Contracts.equal_requires l a b ->
    Contracts.equal_contract l a b result <-> result = mark_eqb a b.

Definition gene_clocks_restore_contract : Prop :=
  forall l n d n2 d2 result n' d', Contracts.restore_requires l n d n2 d2 ->
    Contracts.restore_contract l n d n2 d2 result n' d' <-> leaves (restore l n2 d2) n d result n' d'.

Definition gene_clocks_start_contract : Prop :=
  forall l n d result n' d', Contracts.start_requires l n d (genesis_count l) ->
    Contracts.start_contract l n d (genesis_count l) result n' d'
    <-> leaves (if genesis_count l <? maximum l then Some (Clock (start l) (start l)) else None)
          n d result n' d'.

Definition gene_clocks_restart_contract : Prop :=
  forall l n d stored result n' d', Contracts.restart_requires l n d (genesis_count l) stored ->
    Contracts.restart_contract l n d (genesis_count l) stored result n' d'
    <-> leaves (restart l stored) n d result n' d'.

Definition gene_clocks_reserve_contract : Prop :=
  forall l n d n' d', Contracts.reserve_requires l n d ->
    Contracts.reserve_contract l n d n' d' <-> Clock n' d' = reserve l (Clock n d).

Definition gene_clocks_mint_contract : Prop :=
  forall l n d first count result n' d' first', Contracts.mint_requires l n d first count ->
    Contracts.mint_contract l n d first count result n' d' first' <->
    match mint l (Clock n d) count with
    | Some (taken, c) => result = true /\ first' = taken /\ n' = next c /\ d' = durable c
    | None => result = false /\ first' = first /\ n' = n /\ d' = d
    end.

Definition gene_clocks_observe_contract : Prop :=
  forall l n d stamp result n' d', Contracts.observe_requires l n d stamp ->
    Contracts.observe_contract l n d stamp result n' d'
    <-> leaves (observe l (Clock n d) stamp) n d result n' d'.

Definition gene_clocks_covers_contract : Prop :=
  forall l stamp genome size result, Contracts.covers_requires l stamp genome size ->
    Contracts.covers_contract l stamp genome size result <-> result = covers stamp genome.

Definition gene_clocks_find_unmade_contract : Prop :=
  forall l n robot genome size result, Contracts.find_unmade_requires l n robot genome size ->
    Contracts.find_unmade_contract l n robot genome size result
    <-> result = N.of_nat (find_unmade n robot genome).

Definition gene_clocks_earn_contract : Prop :=
  forall l held p held', Contracts.earn_requires l held (per_cycle p) (ceiling p) ->
    Contracts.earn_contract l held (per_cycle p) (ceiling p) held' <-> held' = earn p held.

Definition gene_clocks_admit_contract : Prop :=
  forall l n d g stamp result n' d' held', Contracts.admit_requires l n d (allowance g) stamp ->
    Contracts.admit_contract l n d (allowance g) stamp result n' d' held' <->
    match accept l (Clock n d) g stamp with
    | inl (c, g') => result = gene_clocks_admitted /\ n' = next c /\ d' = durable c
        /\ held' = allowance g'
    | inr why => Int result = refusal_value why /\ n' = n /\ d' = d /\ held' = allowance g
    end.

(** * The contracts say what the model says *)
From Coq Require Import ZArith NArith List Bool Lia.
From Refinement Require Import Semantics Kernel Statements Adequacy.
From Refinement Require Contracts.
From GeneClocks Require Import Mark Clock Admission.
Import ListNotations.
Open Scope N_scope.

Ltac ways := repeat match goal with
  | |- context [N.ltb ?a ?b] => destruct (N.ltb_spec a b)
  | h : context [N.ltb ?a ?b] |- _ => destruct (N.ltb_spec a b)
  | |- context [N.leb ?a ?b] => destruct (N.leb_spec a b)
  | h : context [N.leb ?a ?b] |- _ => destruct (N.leb_spec a b)
  | |- context [N.eqb ?a ?b] => destruct (N.eqb_spec a b)
  end; cbn [next durable orb andb negb allowance] in *; try lia.

(** Each side of the equivalence from the other, by arithmetic. *)
Ltac agree :=
  unfold leaves, Contracts.usable, Contracts.reserved in *; cbn [next durable allowance] in *;
  try match goal with result : bool |- _ => destruct result end;
  ways; repeat match goal with h : _ /\ _ |- _ => destruct h end;
  split; intros; repeat match goal with h : _ /\ _ |- _ => destruct h end;
  repeat match goal with
  | h : ?p -> _ |- _ => match type of p with Prop =>
      let q := fresh in assert (q : p) by (intuition (lia || discriminate)); specialize (h q); clear q end
  end;
  ways; subst; intuition (try discriminate; try congruence; try lia).

Theorem gene_clocks_less_contract : Adequacy.gene_clocks_less_contract.
Proof.
  intros l [c r] [c' r'] result _. unfold Contracts.less_contract, Contracts.below, mark_ltb, mark_compare.
  cbn. destruct (N.compare_spec c c'), (N.compare_spec r r'), result; intuition (try discriminate; lia).
Qed.

Theorem gene_clocks_equal_contract : Adequacy.gene_clocks_equal_contract.
Proof.
  intros l [c r] [c' r'] result _. unfold Contracts.equal_contract, Contracts.same, mark_eqb, mark_compare.
  cbn. destruct (N.compare_spec c c'), (N.compare_spec r r'), result; intuition (try discriminate; lia).
Qed.

Theorem gene_clocks_restore_contract : Adequacy.gene_clocks_restore_contract.
Proof. intros l n d n2 d2 result n' d' _. unfold Contracts.restore_contract, restore. agree. Qed.

Theorem gene_clocks_start_contract : Adequacy.gene_clocks_start_contract.
Proof. intros l n d result n' d' _. unfold Contracts.start_contract, start. agree. Qed.

Theorem gene_clocks_restart_contract : Adequacy.gene_clocks_restart_contract.
Proof. intros l n d stored result n' d' _. unfold Contracts.restart_contract, restart, restore. agree. Qed.

Theorem gene_clocks_reserve_contract : Adequacy.gene_clocks_reserve_contract.
Proof.
  intros l n d n' d' [_ below]. unfold Contracts.reserve_contract, Contracts.reserved, reserve.
  cbn [next durable]. split.
  - intros [-> ->]. ways; f_equal; lia.
  - intros E. ways; injection E as -> ->; ways; split; lia.
Qed.

Theorem gene_clocks_mint_contract : Adequacy.gene_clocks_mint_contract.
Proof.
  intros l n d first count result n' d' first' [[usable _] _].
  unfold Contracts.mint_contract, mint, reserve. agree.
Qed.

Theorem gene_clocks_observe_contract : Adequacy.gene_clocks_observe_contract.
Proof.
  intros l n d stamp result n' d' usable. unfold Contracts.observe_requires in usable.
  unfold Contracts.observe_contract, observe, reserve. agree.
Qed.

Lemma gene_nth genome k m : nth_error genome (N.to_nat k) = Some m -> Contracts.gene genome k = m.
Proof. intros. now apply nth_error_nth. Qed.

Theorem gene_clocks_covers_contract : Adequacy.gene_clocks_covers_contract.
Proof.
  intros l stamp genome size result <-. unfold Contracts.covers_contract.
  assert (said : (forall k, 0 <= k /\ k < N.of_nat (length genome) ->
                   counter (Contracts.gene genome k) < stamp) <-> covers stamp genome = true).
  { unfold covers. rewrite forallb_forall. split.
    - intros all gene here. destruct (In_nth_error _ _ here) as [k found].
      assert (k < length genome)%nat by (apply nth_error_Some; congruence).
      specialize (all (N.of_nat k) ltac:(lia)). rewrite (gene_nth _ _ gene) in all; [|now rewrite Nat2N.id].
      now apply N.ltb_lt.
    - intros all k [_ inside]. destruct (nth_error genome (N.to_nat k)) as [m|] eqn:found.
      + rewrite (gene_nth _ _ m found). apply N.ltb_lt, all. now apply nth_error_In in found.
      + apply nth_error_None in found. lia. }
  rewrite said. split; [apply eq_true_iff_eq|intros ->; reflexivity].
Qed.

Lemma unmade_is m n robot : Contracts.unmade m n robot <-> Admission.unmade n robot m = true.
Proof.
  unfold Contracts.unmade, Admission.unmade. rewrite andb_true_iff, N.eqb_eq, N.leb_le. intuition lia.
Qed.

Lemma find_unmade_bound n robot genome : (find_unmade n robot genome <= length genome)%nat.
Proof. induction genome; cbn; [lia|]. destruct (Admission.unmade _ _ _); lia. Qed.

Lemma find_unmade_before n robot genome : forall k m, (k < find_unmade n robot genome)%nat ->
  nth_error genome k = Some m -> Admission.unmade n robot m = false.
Proof.
  induction genome as [|g rest again]; cbn; intros k m less found; [lia|].
  destruct (Admission.unmade n robot g) eqn:its; [lia|].
  destruct k; cbn in found; [congruence|]. apply (again k); [lia|exact found].
Qed.

Lemma find_unmade_at n robot genome : forall m, nth_error genome (find_unmade n robot genome) = Some m ->
  Admission.unmade n robot m = true.
Proof.
  induction genome as [|g rest again]; cbn; intros m found; [discriminate|].
  destruct (Admission.unmade n robot g) eqn:its; cbn in found;
    [injection found as <-; exact its|now apply again].
Qed.

Theorem gene_clocks_find_unmade_contract : Adequacy.gene_clocks_find_unmade_contract.
Proof.
  intros l n robot genome size result <-. unfold Contracts.find_unmade_contract.
  assert (bound := find_unmade_bound n robot genome).
  assert (gene_at : forall k, k < N.of_nat (length genome) ->
            nth_error genome (N.to_nat k) = Some (Contracts.gene genome k)).
  { intros k inside. destruct (nth_error genome (N.to_nat k)) as [m|] eqn:found.
    - now rewrite (gene_nth _ _ m found).
    - apply nth_error_None in found. lia. }
  split.
  - intros ([_ inside] & before & at_).
    destruct (N.lt_trichotomy result (N.of_nat (find_unmade n robot genome))) as [less|[same|more]];
      [exfalso|exact same|exfalso].
    + assert (short : result < N.of_nat (length genome)) by lia.
      assert (its := at_ short). apply unmade_is in its.
      assert (found := gene_at result short). apply find_unmade_before with (n := n) (robot := robot) in found;
        [congruence|lia].
    + assert (short : N.of_nat (find_unmade n robot genome) < N.of_nat (length genome)) by lia.
      apply (before (N.of_nat (find_unmade n robot genome))); [lia|]. apply unmade_is.
      apply (find_unmade_at n robot genome). rewrite <- (gene_at _ short). now rewrite Nat2N.id.
  - intros ->. split; [lia|]. split.
    + intros k [_ less] its. apply unmade_is in its.
      assert (short : k < N.of_nat (length genome)) by lia.
      assert (found := gene_at k short). apply find_unmade_before with (n := n) (robot := robot) in found;
        [congruence|lia].
    + intros inside. apply unmade_is, (find_unmade_at n robot genome).
      rewrite <- (gene_at _ inside). now rewrite Nat2N.id.
Qed.

Theorem gene_clocks_earn_contract : Adequacy.gene_clocks_earn_contract.
Proof. intros l held p held' _. reflexivity. Qed.

Theorem gene_clocks_admit_contract : Adequacy.gene_clocks_admit_contract.
Proof.
  intros l n d [p held] stamp result n' d' held' [[usable _] _].
  unfold Contracts.admit_contract, accept, beyond, observe, reserve, refusal_value.
  unfold Contracts.usable, Contracts.reserved in *. cbn [next durable allowance].
  assert (injective : forall a b, Int a = Int b <-> a = b) by (intuition congruence).
  destruct usable as (_ & (one & ordered) & bounded).
  unfold gene_clocks_admitted, gene_clocks_beyond_maximum, gene_clocks_beyond_window,
    gene_clocks_beyond_allowance in *.
  ways; rewrite ?injective; split; intros;
    repeat match goal with h : _ /\ _ |- _ => destruct h end;
    repeat match goal with
    | h : ?q -> _ |- _ => match type of q with Prop =>
        let r := fresh in assert (r : q) by (intuition lia); specialize (h r); clear r end
    end; ways; intuition (try lia).
Qed.

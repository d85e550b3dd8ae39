(** * The loops over one genome refine the model *)
From Coq Require Import ZArith NArith String List Bool Lia.
From GeneClocks Require Import Mark Clock Admission.
From Refinement Require Import Semantics Kernel Statements Execution.
Import ListNotations.

(** A loop that counts from 0 in [slot], and of which the rest of the genome at that index decides
    what comes out. *)
Definition counts {A} (slot : nat) (env : locals) (s : state) (genome : list mark)
    (decides : nat -> list mark -> A) (answer : A) (n : nat) (env' : locals) (s' : state) : Prop :=
  exists k, (k <= length genome)%nat /\ n = (length genome - k)%nat
    /\ env' = with_slots env [(slot, Int (Z.of_nat k))] /\ s' = s
    /\ decides k (from k genome) = answer.

Ltac next_round genome k :=
  exists (length genome - S k)%nat; split; [lia|]; exists (S k); split; [lia|]; split; [reflexivity|];
  split; [cbn; same|]; split; [reflexivity|]; cbn -[from]; same.

Ltac counting genome decides answer asked slot :=
  match goal with
  | |- context [iterate _ _ ?env ?s] =>
      at_loop (counts slot env s genome decides answer) (length genome);
      [ let k := fresh "k" in let bound := fresh "bound" in let decided := fresh "decided" in
        intros ? ? ? (k & bound & -> & -> & -> & decided); compute_on; repeat step;
        advance; cbn -[from] in decided; unfold unmade in decided; cbn -[from] in decided; clear asked; subst answer; repeat step;
        first [returned | next_round genome k]
      | exists O; split; [lia|]; split; [lia|]; split; [cbn; same|]; split; [reflexivity|exact asked]
      | lia ]
  end.
(** With the variable, whichever it is, that the loop changes. *)
Ltac in_its_slot f tactic :=
  let slots := eval compute in (loop_slots f) in
  lazymatch slots with
  | [?a] => tactic a
  | ?a :: ?b :: _ => first [tactic a | tactic b]
  end.

Theorem gene_clocks_covers_refines : Statements.gene_clocks_covers_refines.
Proof.
  intros m at_ genome stamp [fit here]. unfold size_value. open_numbers.
  remember (covers stamp genome) as answer eqn:asked. symmetry in asked.
  intros outside fuel enough. enter. repeat step.
  in_its_slot gene_clocks_covers
    ltac:(counting genome (fun (_ : nat) rest => covers stamp rest) answer asked).
Qed.

Theorem gene_clocks_find_unmade_refines : Statements.gene_clocks_find_unmade_refines.
Proof.
  intros m at_ genome next robot [fit here]. unfold size_value. open_numbers.
  remember (find_unmade next robot genome) as answer eqn:asked. symmetry in asked.
  intros outside fuel enough. enter. repeat step.
  in_its_slot gene_clocks_find_unmade
    ltac:(counting genome (fun k rest => (k + find_unmade next robot rest)%nat) answer asked).
Qed.

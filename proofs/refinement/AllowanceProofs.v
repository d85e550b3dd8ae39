(** * The allowance refines the model *)
From Coq Require Import ZArith NArith String List Bool Lia.
From GeneClocks Require Import Mark Clock Admission.
From Refinement Require Import Semantics Kernel Statements Execution.
Import ListNotations.

Theorem gene_clocks_earn_refines : Statements.gene_clocks_earn_refines.
Proof.
  intros m allowance_at held [initial per_cycle ceiling] here below. unfold earn.
  open_numbers. cbn [Admission.per_cycle Admission.ceiling] in *. intros. run_to_the_end.
Qed.

Theorem gene_clocks_admit_refines : Statements.gene_clocks_admit_refines.
Proof.
  intros m state limits_at allowance_at c l [p held] stamp here there apart apart' its its' arguments.
  cbn [allowance] in *. open_numbers.
  match goal with
  | |- match ?answer with inl _ => _ | inr _ => _ end =>
      assert (computes "gene_clocks_admit" arguments m
                (match answer with
                 | inl _ => Int gene_clocks_admitted
                 | inr why => refusal_value why
                 end)
                (match answer with
                 | inl (c', g') =>
                     write (write m state (clock_value c')) allowance_at (number_value (allowance g'))
                 | inr _ => m
                 end)); [|now destruct answer as [[]|]]
  end.
  subst arguments. unfold accept, beyond, observe, reserve. run_to_the_end.
Qed.

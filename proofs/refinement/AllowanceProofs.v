(** * The allowance refines the model *)
From Coq Require Import ZArith NArith String List Bool Lia.
From GeneClocks Require Import Mark Clock.
From GeneClocks Require Admission.
From Refinement Require Import Semantics Kernel Statements Execution.
Import ListNotations.

Theorem gene_clocks_earn_refines : Statements.gene_clocks_earn_refines.
Proof.
  intros m allowance held [initial per_cycle ceiling] here below. unfold Admission.earn.
  open_numbers. cbn [Admission.per_cycle Admission.ceiling] in *. intros. run_to_the_end.
Qed.

Theorem gene_clocks_admit_refines : Statements.gene_clocks_admit_refines.
Proof.
  intros m state limits_at allowance c l held stamp here there apart apart' its its' arguments g.
  subst arguments g. open_numbers.
  apply (answered _ _ _ _ (fun _ => Int gene_clocks_admitted)).
  unfold Admission.accept, why_refused, observe, reserve. run_to_the_end.
Qed.

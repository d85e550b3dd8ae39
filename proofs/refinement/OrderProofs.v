(** * The order of marks refines the model *)
From Coq Require Import ZArith NArith String List Bool Lia.
From GeneClocks Require Import Mark Clock.
From Refinement Require Import Semantics Kernel Statements Execution.
Import ListNotations.

Theorem gene_clocks_less_refines : Statements.gene_clocks_less_refines.
Proof.
  intros m a b. open_numbers. unfold mark_ltb, mark_compare. run_to_the_end.
Qed.

Theorem gene_clocks_equal_refines : Statements.gene_clocks_equal_refines.
Proof.
  intros m a b. open_numbers. unfold mark_eqb, mark_compare. run_to_the_end.
Qed.

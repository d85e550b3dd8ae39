(** * Reception refines the model *)
From Coq Require Import ZArith NArith String List Bool Lia.
From GeneClocks Require Import Mark Clock.
From Refinement Require Import Semantics Kernel Statements Execution.
Import ListNotations.

Theorem gene_clocks_observe_refines : Statements.gene_clocks_observe_refines.
Proof.
  intros m state limits_at c l stamp here its. open_numbers. apply answered.
  unfold observe, reserve. run_to_the_end.
Qed.

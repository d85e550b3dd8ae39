(** * Taking up a state refines the model *)
From Coq Require Import ZArith NArith String List Bool Lia.
From GeneClocks Require Import Mark Clock.
From Refinement Require Import Semantics Kernel Statements Execution.
Import ListNotations.

Theorem gene_clocks_restore_refines : Statements.gene_clocks_restore_refines.
Proof.
  intros m state limits_at old l c here its. open_numbers. apply answered.
  unfold restore. run_to_the_end.
Qed.

Theorem gene_clocks_start_refines : Statements.gene_clocks_start_refines.
Proof.
  intros m state limits_at old l here its. open_numbers. apply answered.
  unfold start. run_to_the_end.
Qed.

Theorem gene_clocks_restart_refines : Statements.gene_clocks_restart_refines.
Proof.
  intros m state limits_at old l stored here its its'. open_numbers. apply answered.
  unfold restart, restore. run_to_the_end.
Qed.

(** * Reserving and minting refine the model *)
From Coq Require Import ZArith NArith String List Bool Lia.
From GeneClocks Require Import Mark Clock.
From Refinement Require Import Semantics Kernel Statements Execution.
Import ListNotations.

Theorem gene_clocks_reserve_refines : Statements.gene_clocks_reserve_refines.
Proof.
  intros m state limits_at c l here below. unfold reserve. open_numbers. run_to_the_end.
Qed.

Theorem gene_clocks_mint_refines : Statements.gene_clocks_mint_refines.
Proof.
  intros m state limits_at first c l count here there apart apart' below its arguments.
  open_numbers. destruct (m first) as [before|] eqn:found; [clear there|contradiction].
  match goal with
  | |- match ?answer with Some _ => _ | None => _ end =>
      assert (computes "gene_clocks_mint" arguments m
                (bool_value (if answer then true else false))
                (match answer with
                 | Some (taken, c') => write (write m state (clock_value c')) first (number_value taken)
                 | None => m
                 end)); [|now destruct answer as [[]|]]
  end.
  subst arguments. unfold mint, reserve. run_to_the_end.
Qed.

(** * Marks (innovation numbers) and their order

    Mirrors [protocol/include/gene_clocks/innovation_number.hpp]. *)
From Coq Require Import NArith List Sorting.Sorted.
Open Scope N_scope.

(** The paper's ⟨r, c_r⟩: the counter that a gene took, and the robot that took it. *)
Record mark := Mark { counter : N; maker : N }.

(** Counter first, then robot. *)
Definition mark_compare (a b : mark) : comparison :=
  match counter a ?= counter b with
  | Eq => maker a ?= maker b
  | different => different
  end.

Definition mark_lt (a b : mark) : Prop := mark_compare a b = Lt.
Infix "<<" := mark_lt (at level 70, no associativity).

Definition mark_eqb (a b : mark) : bool :=
  match mark_compare a b with Eq => true | _ => false end.

(** Strictly ascending, hence without repetition: the form in which genomes are kept. *)
Definition sorted : list mark -> Prop := StronglySorted mark_lt.

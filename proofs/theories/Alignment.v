(** * Alignment of two genomes

    Mirrors [protocol/include/gene_clocks/align.hpp]: one linear merge, whatever else a gene holds
    beside its mark (the projection [mark_of]). *)
From Coq Require Import NArith List.
From GeneClocks Require Import Mark.
Import ListNotations.

Inductive side := First | Second.

Inductive aligned (gene : Type) :=
| Matching (a b : gene)           (** the mark is in both genomes *)
| Disjoint (s : side) (a : gene)  (** on side [s] only, below the other genome's last mark *)
| Excess (s : side) (a : gene).   (** on side [s] only, beyond the other genome's last mark *)
Arguments Matching {gene}. Arguments Disjoint {gene}. Arguments Excess {gene}.

Section Alignment.
Context {gene : Type} (mark_of : gene -> mark).

Fixpoint align (first : list gene) : list gene -> list (aligned gene) :=
  fix advance_second (second : list gene) : list (aligned gene) :=
    match first, second with
    | [], _ => map (Excess Second) second
    | _, [] => map (Excess First) first
    | a :: first', b :: second' =>
        match mark_compare (mark_of a) (mark_of b) with
        | Eq => Matching a b :: align first' second'
        | Lt => Disjoint First a :: align first' second
        | Gt => Disjoint Second b :: advance_second second'
        end
    end.

(** ** What the words mean, without reference to the algorithm *)

Definition has_mark (genes : list gene) (m : mark) : Prop := In m (map mark_of genes).

Definition own (s : side) (first second : list gene) : list gene :=
  match s with First => first | Second => second end.
Definition opposite (s : side) : side := match s with First => Second | Second => First end.
Definition other (s : side) (first second : list gene) : list gene :=
  own (opposite s) first second.

Definition classified (first second : list gene) (c : aligned gene) : Prop :=
  match c with
  | Matching a b => In a first /\ In b second /\ mark_of a = mark_of b
  | Disjoint s a => In a (own s first second) /\ ~ has_mark (other s first second) (mark_of a)
      /\ exists b, In b (other s first second) /\ mark_of a << mark_of b
  | Excess s a => In a (own s first second) /\ ~ has_mark (other s first second) (mark_of a)
      /\ forall b, In b (other s first second) -> mark_of b << mark_of a
  end.

(** ** Reading an alignment *)

Definition mirror (c : aligned gene) : aligned gene :=
  match c with
  | Matching a b => Matching b a
  | Disjoint s a => Disjoint (opposite s) a
  | Excess s a => Excess (opposite s) a
  end.

Definition genes_of (s : side) (c : aligned gene) : list gene :=
  match c, s with
  | Matching a _, First | Matching _ a, Second => [a]
  | Disjoint First a, First | Disjoint Second a, Second => [a]
  | Excess First a, First | Excess Second a, Second => [a]
  | _, _ => []
  end.

Definition aligned_mark (c : aligned gene) : mark :=
  match c with Matching a _ | Disjoint _ a | Excess _ a => mark_of a end.

Definition matches (alignment : list (aligned gene)) : list (gene * gene) :=
  flat_map (fun c => match c with Matching a b => [(a, b)] | _ => [] end) alignment.
Definition disjoint_count (alignment : list (aligned gene)) : nat :=
  length (filter (fun c => match c with Disjoint _ _ => true | _ => false end) alignment).
Definition excess_count (alignment : list (aligned gene)) : nat :=
  length (filter (fun c => match c with Excess _ _ => true | _ => false end) alignment).
End Alignment.

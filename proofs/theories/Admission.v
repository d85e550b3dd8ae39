(** * Admission against an allowance

    What [protocol/include/gene_clocks/admission_gate.hpp] adds to one clock. Whatever other robots,
    the network and strangers do, this clock only notices the stamps that it hears; so the list of
    events is any at all. *)
From Coq Require Import NArith List.
From GeneClocks Require Import Clock.
Import ListNotations.
Open Scope N_scope.

Record policy := Policy {
  initial : N;    (** counters that receptions may add to begin with *)
  per_cycle : N;  (** … and with each cycle that goes by *)
  ceiling : N     (** what an allowance saturates at: the largest number that fits *)
}.

Record guarded := Guarded { clock_of : clock; allowance : N }.

Definition earn (p : policy) (held : N) : N := N.min (held + per_cycle p) (ceiling p).

(** Reception of a stamp that is also paid for. *)
Definition accept (l : limits) (g : guarded) (stamp : N) : option guarded :=
  match observe l (clock_of g) stamp with
  | None => None
  | Some c =>
      let leap := next c - next (clock_of g) in
      if allowance g <? leap then None else Some (Guarded c (allowance g - leap))
  end.

Inductive event :=
| Makes (count : N)
| Elapses
| Hears (stamp : N).

Definition react (l : limits) (p : policy) (g : guarded) (e : event) : guarded :=
  match e with
  | Makes count =>
      match mint l (clock_of g) count with
      | Some (_, c) => Guarded c (allowance g)
      | None => g
      end
  | Elapses => Guarded (clock_of g) (earn p (allowance g))
  | Hears stamp => match accept l g stamp with Some g' => g' | None => g end
  end.

Definition guard (p : policy) (c : clock) : guarded := Guarded c (initial p).

Definition live (l : limits) (p : policy) (c : clock) (events : list event) : guarded :=
  fold_left (react l p) events (guard p c).

Fixpoint cycles (events : list event) : N :=
  match events with
  | [] => 0
  | Elapses :: rest => 1 + cycles rest
  | _ :: rest => cycles rest
  end.

Fixpoint own_genes (events : list event) : N :=
  match events with
  | [] => 0
  | Makes count :: rest => count + own_genes rest
  | _ :: rest => own_genes rest
  end.

(** What has been earned after these events, spent or not. *)
Definition earned (p : policy) (events : list event) : N :=
  initial p + per_cycle p * cycles events.

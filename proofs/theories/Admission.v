(** * The admission gate

    What [protocol/include/gene_clocks/admission_gate.hpp] asks before a message reaches the clock.
    [Protocol.v] hands the gate what a robot hears, and keeps what the gate remembers; of its rule
    the proofs use only that it refuses more than the clock does ([proofs/Invariant.v], [pass_some]). *)
From Coq Require Import NArith List Bool.
From GeneClocks Require Import Mark Clock.
Import ListNotations.
Open Scope N_scope.

Record policy := Policy {
  initial : N;    (** counters that receptions may add to begin with *)
  per_cycle : N;  (** … and with each cycle that goes by *)
  ceiling : N     (** what an allowance saturates at: the largest number that fits *)
}.

(** What a gate remembers. *)
Record gate := Gate { law : policy; allowance : N }.

Definition opened (p : policy) : gate := Gate p (initial p).

(** A cycle has gone by. *)
Definition earn (p : policy) (held : N) : N := N.min (held + per_cycle p) (ceiling p).
Definition elapse (g : gate) : gate := Gate (law g) (earn (law g) (allowance g)).

(** Why a message is refused. *)
Inductive refusal :=
| BeyondMaximum     (** its stamp exceeds the maximum *)
| BeyondWindow      (** its stamp leaps further than the window *)
| BeyondAllowance   (** its stamp leaps further than has been earned by now *)
| NotCovered        (** a gene does not lie below the stamp *)
| IdentityConflict. (** a gene bears the receiver's id, but the receiver never made it *)

(** A stamp that a clock by itself refuses lies beyond one of two limits. *)
Definition beyond (l : limits) (stamp : N) : refusal :=
  if maximum l <? stamp then BeyondMaximum else BeyondWindow.

(** Reception of a stamp that is also paid for. *)
Definition accept (l : limits) (c : clock) (g : gate) (stamp : N) : (clock * gate) + refusal :=
  match observe l c stamp with
  | None => inr (beyond l stamp)
  | Some c' =>
      let leap := next c' - next c in
      if allowance g <? leap then inr BeyondAllowance
      else inl (c', Gate (law g) (allowance g - leap))
  end.

(** A mark of robot [r], whose clock stands at [n], that it has not made. *)
Definition unmade (n r : N) (gene : mark) : bool := (maker gene =? r) && (n <=? counter gene).

(** A message at the gate of robot [r], all of whose genes lie below its stamp. *)
Definition pass (l : limits) (r : N) (c : clock) (g : gate) (stamp : N) (genes : list mark)
  : (clock * gate) + refusal :=
  if existsb (unmade (next c) r) genes then inr IdentityConflict else accept l c g stamp.

(** * Traces: what a real run leaves behind

    The entries of the file that [docs/trace-format.md] describes, a checker for them, and what
    "unique" and "happened before" mean of a trace, without reference to the checker.

    A trace shows only what can be seen from outside: how far each robot reserves is its own
    affair, as long as nothing leaves it before its counter is stored. *)
From Coq Require Import NArith List Bool FMapPositive.
From GeneClocks Require Import Mark Clock.
Import ListNotations.
Open Scope N_scope.

Inductive entry :=
| Mints (robot first count : N)      (** new genes took the counters [first] … [first + count - 1] *)
| Sends (robot stamp newest : N)     (** with a genome whose largest counter is [newest] *)
| Receives (robot message next : N) (** accepted the trace's [message]-th one (from 0); now [next] *)
| Stores (robot value : N)           (** [value] reached stable storage *)
| Restarts (robot next : N).         (** after a crash, the clock goes on from [next] *)

Definition robot_of (e : entry) : N :=
  match e with
  | Mints r _ _ | Sends r _ _ | Receives r _ _ | Stores r _ | Restarts r _ => r
  end.

(** ** The checker *)

Inductive violation :=
| NotNextCounter      (** a gene took a counter that is not its robot's next *)
| MintedBeyondMaximum       (** counters beyond the maximum were taken *)
| WrongStamp          (** the stamp is not the sender's next counter *)
| SentBeforeStored    (** a message left while the counter was ahead of storage *)
| GeneAboveStamp      (** a message holds a gene that is not below its stamp *)
| NoSuchMessage       (** a message was received that had not been sent *)
| NotAdmitted         (** a stamp beyond the maximum or the admission window was accepted *)
| WrongMaximum        (** after reception the clock is not the larger of its own and the stamp *)
| StoredBackwards     (** storage went back, or beyond the maximum *)
| WrongRestart.       (** after a crash the clock did not go on from what was stored *)

(** What the checker remembers of a robot, and of the fleet. *)
Record seat := Seat { next_of : N; stored_of : N }.
Record checker := Checker {
  seats : PositiveMap.t seat;
  stamps : PositiveMap.t N;  (** of every message sent, by number *)
  sent : N                   (** how many *)
}.

Definition verdict (A : Type) : Type := A + violation.
Definition require {A} (condition : bool) (otherwise : violation) (go_on : verdict A) : verdict A :=
  if condition then go_on else inr otherwise.

Section Check.
Context (l : limits).

Definition key (n : N) : positive := N.succ_pos n.

Definition seat_of (c : checker) (r : N) : seat :=
  match PositiveMap.find (key r) (seats c) with
  | Some s => s
  | None => Seat (start l) (start l)
  end.

Definition sit (c : checker) (r : N) (s : seat) : checker :=
  Checker (PositiveMap.add (key r) s (seats c)) (stamps c) (sent c).

(** The proved clock's own arithmetic; what it would reserve is of no concern here. *)
Definition memory_of (s : seat) : clock := Clock (next_of s) (next_of s).

Definition check_entry (c : checker) (e : entry) : verdict checker :=
  let s := seat_of c (robot_of e) in
  match e with
  | Mints r first count =>
      require (first =? next_of s) NotNextCounter
      match mint l (memory_of s) count with
      | Some (_, clock) => inl (sit c r (Seat (next clock) (stored_of s)))
      | None => inr MintedBeyondMaximum
      end
  | Sends r stamp newest =>
      require (stamp =? next_of s) WrongStamp (
      require (stamp <=? stored_of s) SentBeforeStored (
      require (newest <? stamp) GeneAboveStamp (
      inl (Checker (seats c) (PositiveMap.add (key (sent c)) stamp (stamps c)) (sent c + 1)))))
  | Receives r message next_after =>
      match PositiveMap.find (key message) (stamps c) with
      | None => inr NoSuchMessage
      | Some stamp =>
          match observe l (memory_of s) stamp with
          | None => inr NotAdmitted
          | Some clock =>
              require (next_after =? next clock) WrongMaximum (
              inl (sit c r (Seat (next clock) (stored_of s))))
          end
      end
  | Stores r value =>
      require ((stored_of s <=? value) && (value <=? maximum l)) StoredBackwards (
      inl (sit c r (Seat (next_of s) value)))
  | Restarts r next_after =>
      require (next_after =? stored_of s) WrongRestart (
      inl (sit c r (Seat next_after next_after)))
  end.

Definition check_init : checker :=
  Checker (PositiveMap.empty seat) (PositiveMap.empty N) 0.

(** The whole trace, or the first entry that breaks a rule. *)
Fixpoint check_from (c : checker) (position : nat) (trace : list entry)
  : checker + nat * violation :=
  match trace with
  | [] => inl c
  | e :: rest =>
      match check_entry c e with
      | inl c' => check_from c' (S position) rest
      | inr broken => inr (position, broken)
      end
  end.
Definition check_trace (trace : list entry) : checker + nat * violation :=
  check_from check_init 0 trace.
Definition accepted (trace : list entry) : Prop := exists c, check_trace trace = inl c.
End Check.

(** ** What a trace says, without reference to the checker; positions count from 0 *)

Section Meaning.
Context (trace : list entry).

Definition mints (i : nat) (gene : mark) : Prop :=
  exists first count, nth_error trace i = Some (Mints (maker gene) first count)
    /\ first <= counter gene < first + count.

(** The clock of an entry's robot right after it, where the trace shows it. *)
Definition shows (i : nat) (r n : N) : Prop :=
  match nth_error trace i with
  | Some (Mints r' first count) => r' = r /\ n = first + count
  | Some (Sends r' stamp _) => r' = r /\ n = stamp
  | Some (Receives r' _ next) | Some (Restarts r' next) => r' = r /\ n = next
  | Some (Stores _ _) | None => False
  end.

(** After position [i] and up to [j], robot [r] did not restart from below [n]: what it knew at [i],
    when its clock was [n], it still knows at [j]. *)
Definition remembers (r : N) (i j : nat) (n : N) : Prop :=
  forall k value, (i < k <= j)%nat -> nth_error trace k = Some (Restarts r value) -> n <= value.

Definition survives (i : nat) (gene : mark) : Prop :=
  remembers (maker gene) i (length trace) (counter gene + 1).

(** How many messages were sent before position [i]: the number of a message sent there. *)
Definition sent_before (i : nat) : nat :=
  length (filter (fun e => match e with Sends _ _ _ => true | _ => false end) (firstn i trace)).

Inductive trace_before : nat -> nat -> Prop :=
| trace_same_robot i j r n m : shows i r n -> shows j r m -> (i < j)%nat -> remembers r i j n ->
    trace_before i j
| trace_same_message i j r stamp newest r' next :
    nth_error trace i = Some (Sends r stamp newest) ->
    nth_error trace j = Some (Receives r' (N.of_nat (sent_before i)) next) -> trace_before i j
| trace_in_between i j k : trace_before i j -> trace_before j k -> trace_before i k.
End Meaning.

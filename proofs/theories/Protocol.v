(** * The protocol: robots, a network, crashes

    One executable function, [step], from a world and a command to a world and an answer. Every
    theorem is about [run], its iteration over any list of commands; the oracle of the
    differential test is the same function, extracted.

    The network only ever gains messages, and a command may deliver any of them to any robot at
    any time: loss, duplication, delay and reordering are all there. [Inject] is a forged message.
    Storage is asynchronous: memory runs ahead of it, each write completes in its own time
    ([Persist]), and a [Crash] may strike anywhere between. What is written may also lie beyond
    need, as where a robot keeps other numbers by the same stored counter. *)
From Coq Require Import NArith List Bool.
From GeneClocks Require Import Mark Clock Admission.
Import ListNotations.
Open Scope N_scope.

Record message := Message { stamp : N; genes : list mark }.

(** What each robot may set as it likes, anew in each life. *)
Record settings := Settings { own_block : N; own_policy : option policy }.

Record robot := Robot {
  memory : clock;
  stored : N;           (** the counter on stable storage *)
  known : list mark;    (** every mark of every genome that it holds, and maybe more *)
  block_of : N;         (** how far ahead of need it reserves *)
  guard : option gate   (** what stands before its clock, if anything does *)
}.

(** ** The rules of the protocol

    Each in a place of its own, so that [proofs/Counterexamples.v] can break one at a time. *)
Record rules := Rules {
  stamp_of : clock -> N;
  merge : limits -> clock -> N -> option clock;
  credible : message -> bool;
  gated : limits -> N -> clock -> gate -> N -> list mark -> (clock * gate) + refusal;
  may_send : robot -> bool;
  resume : limits -> N -> option clock;
  retains : N -> mark -> bool
}.

Definition gene_clocks : rules := {|
  (** A message carries the next unused counter. *)
  stamp_of c := next c;
  (** A receiver takes the maximum, within limits. *)
  merge := observe;
  (** A message whose genes are not all below its stamp is dropped whole. *)
  credible m := forallb (fun gene => counter gene <? stamp m) (genes m);
  (** A gate, where there is one, refuses what its allowance does not pay for, and marks of the
      robot's own that it never made. *)
  gated := pass;
  (** Nothing leaves a robot before what it needs is on stable storage. *)
  may_send r := durable (memory r) <=? stored r;
  (** After a crash the clock goes on from what was stored … *)
  resume := restart;
  (** … and a stored genome with a mark at or above that is dropped. *)
  retains stored gene := counter gene <? stored
|}.

(** ** The record of what happened *)

Inductive action :=
| Minted (gene : mark)
| Sent (message : nat)
| Received (message : nat) (genes : list mark)
| Injected (genes : list mark)     (** a forged message was accepted *)
| Restarted (genes : list mark).   (** with these marks left *)

Record event := Event {
  time : nat;       (** position in the global order, which no robot can see *)
  place : N;        (** the robot *)
  what : action;
  before : N;       (** the clock's [next] before … *)
  after : N         (** … and after *)
}.

Record world := World {
  now : nat;
  robots : N -> robot;
  network : list message;
  history : list event;  (** the events that survive, oldest first *)
  lost : list event      (** those that a crash undid *)
}.

(** [e] is the event at which [gene] was made. *)
Definition makes (w : world) (e : event) (gene : mark) : Prop :=
  In e (history w) /\ what e = Minted gene.

(** An event gives its robot these genes (other than by making them). *)
Definition brings (e : event) (gene : mark) : Prop :=
  match what e with
  | Received _ genes | Injected genes | Restarted genes => In gene genes
  | Minted _ | Sent _ => False
  end.

(** Happened-before (Lamport), with one clause more: a gene's making happened before every event
    that gives the gene to someone, however it got there. *)
Inductive happened_before (h : list event) : event -> event -> Prop :=
| same_robot e1 e2 : In e1 h -> In e2 h ->
    place e1 = place e2 -> (time e1 < time e2)%nat -> happened_before h e1 e2
| same_message e1 e2 k genes : In e1 h -> In e2 h ->
    what e1 = Sent k -> what e2 = Received k genes -> happened_before h e1 e2
| same_gene e1 e2 gene : In e1 h -> In e2 h ->
    what e1 = Minted gene -> brings e2 gene -> (time e1 < time e2)%nat -> happened_before h e1 e2
| in_between e1 e2 e3 :
    happened_before h e1 e2 -> happened_before h e2 e3 -> happened_before h e1 e3.

(** ** Commands and answers *)

Inductive command :=
| Mint (r count : N)
| Send (r : N) (selection : list mark)  (** of what it knows *)
| Receive (r : N) (message : nat)
| Overhear (r : N) (message : nat)      (** takes the stamp alone, without the genes *)
| Inject (r : N) (m : message)
| Elapse (r : N)                        (** a cycle of its gate's time goes by *)
| Persist (r value : N)                 (** the write of any value, needed or not, completes *)
| Crash (r : N) (s : settings).         (** memory is lost; the robot restarts, set like this *)

Inductive answer :=
| Marks (first count : N) | Exhausted
| SentAs (message : nat) | NotDurable
| Accepted | Refused (why : refusal) | NoMessage
| Elapsed
| Persisted | OutOfRange
| Resumed | NotResumed.

Section Step.
Context (the : rules) (l : limits).

Definition genesis : list mark :=
  map (fun i => Mark (N.of_nat i) 0) (seq 1 (N.to_nat (genesis_count l))).

Definition fresh_robot : robot :=
  Robot (Clock (start l) (start l)) (start l) genesis (block l) None.

(** The limits of the fleet, but for the block. *)
Definition own_limits (s : robot) : limits :=
  Limits (maximum l) (block_of s) (window l) (genesis_count l).

Definition update (robots : N -> robot) (r : N) (new : robot) : N -> robot :=
  fun r' => if r' =? r then new else robots r'.

(** Adds events, which happen now, one after the other. *)
Definition commit (w : world) (r : N) (new : robot) (sent : list message) (events : list event) :=
  World (now w + length events) (update (robots w) r new) (network w ++ sent)
        (history w ++ events) (lost w).

Definition event_now (w : world) (r : N) (a : action) (new : robot) : event :=
  Event (now w) r a (next (memory (robots w r))) (next (memory new)).

Fixpoint minted_events (time : nat) (r first : N) (count : nat) : list event :=
  match count with
  | O => []
  | S n => Event time r (Minted (Mark first r)) first (first + 1)
           :: minted_events (S time) r (first + 1) n
  end.
Definition minted_marks (r first : N) (count : nat) : list mark :=
  map (fun i => Mark (first + N.of_nat i) r) (seq 0 count).

(** Merging the stamp and learning the genes is one atomic step. *)
Definition learn (r : N) (s : robot) (m : message) : robot + refusal :=
  let learnt c g := Robot c (stored s) (known s ++ genes m) (block_of s) g in
  if credible the m then
    match guard s with
    | None =>
        match merge the (own_limits s) (memory s) (stamp m) with
        | Some c => inl (learnt c None)
        | None => inr (beyond l (stamp m))
        end
    | Some g =>
        match gated the (own_limits s) r (memory s) g (stamp m) (genes m) with
        | inl (c, g') => inl (learnt c (Some g'))
        | inr why => inr why
        end
    end
  else inr NotCovered.

(** A message reaches a robot, by [how]. *)
Definition hear (w : world) (r : N) (m : message) (how : action) : world * answer :=
  match learn r (robots w r) m with
  | inl new => (commit w r new [] [event_now w r how new], Accepted)
  | inr why => (w, Refused why)
  end.

Definition knows (s : robot) (gene : mark) : bool := existsb (mark_eqb gene) (known s).

(** A crash undoes the events of its robot that its storage does not cover. *)
Definition undone (w : world) (r : N) (e : event) : bool :=
  (place e =? r) && (stored (robots w r) <? after e).

Definition step (w : world) (c : command) : world * answer :=
  match c with
  | Mint r count =>
      let s := robots w r in
      match mint (own_limits s) (memory s) count with
      | Some (first, c) =>
          let n := N.to_nat count in
          (commit w r (Robot c (stored s) (known s ++ minted_marks r first n) (block_of s) (guard s))
                  [] (minted_events (now w) r first n),
           Marks first count)
      | None => (w, Exhausted)
      end
  | Send r selection =>
      let s := robots w r in
      if may_send the s then
        let m := Message (stamp_of the (memory s)) (filter (knows s) selection) in
        let k := length (network w) in
        (commit w r s [m] [event_now w r (Sent k) s], SentAs k)
      else (w, NotDurable)
  | Receive r k =>
      match nth_error (network w) k with
      | Some m => hear w r m (Received k (genes m))
      | None => (w, NoMessage)
      end
  | Overhear r k =>
      match nth_error (network w) k with
      | Some m => hear w r (Message (stamp m) []) (Received k [])
      | None => (w, NoMessage)
      end
  | Inject r m => hear w r m (Injected (genes m))
  | Elapse r =>
      let s := robots w r in
      (commit w r (Robot (memory s) (stored s) (known s) (block_of s) (option_map elapse (guard s)))
              [] [],
       Elapsed)
  | Persist r value =>
      let s := robots w r in
      if value <=? maximum l then
        (commit w r (Robot (memory s) (N.max (stored s) value) (known s) (block_of s) (guard s)) [] [],
         Persisted)
      else (w, OutOfRange)
  | Crash r anew =>
      let s := robots w r in
      match resume the l (stored s) with
      | Some c =>
          let left := filter (retains the (stored s)) (known s) in
          let new := Robot c (stored s) left (own_block anew) (option_map opened (own_policy anew)) in
          (World (S (now w)) (update (robots w) r new) (network w)
                 (filter (fun e => negb (undone w r e)) (history w)
                    ++ [Event (now w) r (Restarted left) (next c) (next c)])
                 (lost w ++ filter (undone w r) (history w)),
           Resumed)
      | None => (w, NotResumed)  (* never: [Claims.crash_is_survived] *)
      end
  end.

Definition init : world := World 0 (fun _ => fresh_robot) [] [] [].

Definition run (commands : list command) : world :=
  fold_left (fun w c => fst (step w c)) commands init.
End Step.

(** * A swarm whose clocks are the shipped functions

    The protocol of [Protocol.v] where every step of a clock, of a gate and of a check is taken by
    running the translated C text on memory in which the clock, its limits and what else it needs
    are laid out. What is undefined in C would be a refusal here; that it never is, is what
    [Statements.v] says. *)
From Coq Require Import ZArith NArith String List Bool.
From Refinement Require Import Semantics Kernel Statements.
From GeneClocks Require Import Mark Clock Admission Protocol.
Import ListNotations.
Open Scope string_scope.
Open Scope N_scope.

(** ** Objects in memory, one a block, and a genome in a block of its own *)

Definition laid (objects : list value) (genome : list mark) : Semantics.memory := fun a =>
  if fst a =? 9 then
    if (0 <=? snd a)%Z then option_map mark_value (nth_error genome (Z.to_nat (snd a))) else None
  else if (snd a =? 0)%Z then nth_error objects (N.to_nat (fst a)) else None.
Definition object (block : N) : address := (block, 0%Z).
Definition to (block : N) : value := Pointer (object block).

Definition run_c (rounds : nat) (function : string) (arguments : list value) (m : Semantics.memory)
    : option (value * Semantics.memory) :=
  match Semantics.run kernel (fun _ _ m => m) (S rounds) function arguments (State m []) with
  | Some (result, s) => Some (result, memory_of s)
  | None => None
  end.

Definition number_in (m : Semantics.memory) (a : address) : option N :=
  match m a with Some (Int z) => Some (Z.to_N z) | _ => None end.
Definition clock_in (m : Semantics.memory) (a : address) : option clock :=
  match m a with
  | Some (Struct [(_, Int n); (_, Int d)]) => Some (Clock (Z.to_N n) (Z.to_N d))
  | _ => None
  end.

(** ** The functions *)

Definition shipped_mint (l : limits) (c : clock) (count : N) : option (N * clock) :=
  match run_c 0 "gene_clocks_mint" [to 0; to 1; number_value count; to 2]
          (laid [clock_value c; limits_value l; Undefined] []) with
  | Some (Int 1, m) =>
      match number_in m (object 2), clock_in m (object 0) with
      | Some first, Some c' => Some (first, c')
      | _, _ => None
      end
  | _ => None
  end.

(** A function that takes up a clock, from the one that is there. *)
Definition shipped_clock (function : string) (more : list value) (l : limits) (c : clock)
    : option clock :=
  match run_c 0 function ([to 0; to 1] ++ more) (laid [clock_value c; limits_value l] []) with
  | Some (Int 1, m) => clock_in m (object 0)
  | _ => None
  end.
Definition shipped_observe (l : limits) (c : clock) (stamp : N) : option clock :=
  shipped_clock "gene_clocks_observe" [number_value stamp] l c.
Definition shipped_start (l : limits) : option clock :=
  shipped_clock "gene_clocks_start" [number_value (genesis_count l)] l (Clock 0 0).
Definition shipped_restart (l : limits) (stored : N) : option clock :=
  shipped_clock "gene_clocks_restart" [number_value (genesis_count l); number_value stored] l
    (Clock 0 0).

Definition shipped_covers (stamp : N) (genome : list mark) : bool :=
  match run_c (length genome) "gene_clocks_covers"
          [number_value stamp; to 9; size_value genome] (laid [] genome) with
  | Some (Int 1, _) => true
  | _ => false
  end.
Definition shipped_find_unmade (next robot : N) (genome : list mark) : option N :=
  match run_c (length genome) "gene_clocks_find_unmade"
          [number_value next; number_value robot; to 9; size_value genome] (laid [] genome) with
  | Some (Int z, _) => Some (Z.to_N z)
  | _ => None
  end.

Definition shipped_elapse (g : gate) : gate :=
  match run_c 0 "gene_clocks_earn"
          [to 0; number_value (per_cycle (law g)); number_value (ceiling (law g))]
          (laid [number_value (allowance g)] []) with
  | Some (_, m) => match number_in m (object 0) with Some held => Gate (law g) held | None => g end
  | None => g
  end.

Definition refusal_of (z : Z) : refusal :=
  if (z =? gene_clocks_beyond_maximum)%Z then BeyondMaximum
  else if (z =? gene_clocks_beyond_window)%Z then BeyondWindow
  else if (z =? gene_clocks_beyond_allowance)%Z then BeyondAllowance
  else if (z =? gene_clocks_gene_not_covered)%Z then NotCovered else IdentityConflict.
Definition shipped_admit (l : limits) (c : clock) (g : gate) (stamp : N) : (clock * gate) + refusal :=
  match run_c 0 "gene_clocks_admit" [to 0; to 1; to 2; number_value stamp]
          (laid [clock_value c; limits_value l; number_value (allowance g)] []) with
  | Some (Int z, m) =>
      if (z =? gene_clocks_admitted)%Z then
        match clock_in m (object 0), number_in m (object 2) with
        | Some c', Some held => inl (c', Gate (law g) held)
        | _, _ => inr NotCovered
        end
      else inr (refusal_of z)
  | _ => inr NotCovered
  end.

(** ** The protocol with them *)

Definition shipped_pass (l : limits) (r : N) (c : clock) (g : gate) (stamp : N) (genes : list mark)
    : (clock * gate) + refusal :=
  match shipped_find_unmade (next c) r genes with
  | Some index =>
      if index <? N.of_nat (length genes) then inr IdentityConflict else shipped_admit l c g stamp
  | None => inr NotCovered
  end.

Definition shipped : rules := {|
  stamp_of := stamp_of gene_clocks;
  merge := shipped_observe;
  credible m := shipped_covers (stamp m) (genes m);
  gated := shipped_pass;
  may_send := may_send gene_clocks;
  resume := shipped_restart;
  retains := retains gene_clocks
|}.

(** As [Protocol.step], with the shipped functions where that calls the model's. *)
Definition shipped_step (l : limits) (w : world) (c : command) : world * answer :=
  match c with
  | Mint r count =>
      let s := robots w r in
      match shipped_mint (own_limits l s) (memory s) count with
      | Some (first, c) =>
          let n := N.to_nat count in
          (commit w r (Robot c (stored s) (known s ++ minted_marks r first n)%list (block_of s) (guard s))
                  [] (minted_events (now w) r first n),
           Marks first count)
      | None => (w, Exhausted)
      end
  | Elapse r =>
      let s := robots w r in
      (commit w r
              (Robot (memory s) (stored s) (known s) (block_of s) (option_map shipped_elapse (guard s)))
              [] [],
       Elapsed)
  | c => step shipped l w c
  end.

Definition shipped_robot (l : limits) : robot :=
  match shipped_start l with
  | Some c => Robot c (durable c) (genesis l) (block l) None
  | None => fresh_robot l
  end.
Definition shipped_run (l : limits) (commands : list command) : world :=
  fold_left (fun w c => fst (shipped_step l w c)) commands
    (World 0 (fun _ => shipped_robot l) [] [] []).

(** What a C program can be told: numbers that fit their types. *)
Definition policy_fits (p : policy) : Prop :=
  initial p <= ceiling p /\ fits gene_clocks_counter (ceiling p)
  /\ fits gene_clocks_counter (per_cycle p).
Definition representable (c : command) : Prop :=
  match c with
  | Mint _ count => fits gene_clocks_counter count
  | Send _ selection => fits size_t (N.of_nat (length selection))
  | Inject _ m => fits gene_clocks_counter (stamp m) /\ fits size_t (N.of_nat (length (genes m)))
  | Crash _ anew =>
      fits gene_clocks_counter (own_block anew)
      /\ match own_policy anew with Some p => policy_fits p | None => True end
  | Receive _ _ | Overhear _ _ | Elapse _ | Persist _ _ => True
  end.
Definition told_to (l : limits) (commands : list command) : Prop :=
  valid l /\ limits_fit l /\ Forall representable commands.

(** ** What is claimed of such a swarm; compare [Claims.v] *)

Definition shipped_is_model : Prop :=
  forall l commands, told_to l commands -> shipped_run l commands = run gene_clocks l commands.

Definition shipped_marks_unique : Prop :=
  forall l commands e1 e2 gene, told_to l commands -> let w := shipped_run l commands in
    makes w e1 gene -> makes w e2 gene -> e1 = e2.

Definition shipped_clock_condition : Prop :=
  forall l commands e1 e2 a b, told_to l commands -> let w := shipped_run l commands in
    makes w e1 a -> makes w e2 b -> happened_before (history w) e1 e2 -> counter a < counter b.

Definition shipped_never_wraps : Prop :=
  forall l commands r, told_to l commands ->
    let w := shipped_run l commands in let s := robots w r in
    start l <= next (memory s) <= durable (memory s) /\ durable (memory s) <= maximum l
    /\ start l <= stored s <= maximum l
    /\ (forall e gene, makes w e gene -> start l <= counter gene < maximum l)
    /\ (forall m, In m (network w) -> stamp m <= maximum l).

Definition shipped_nothing_sent_is_forgotten : Prop :=
  forall l commands e k, told_to l commands -> let w := shipped_run l commands in what e = Sent k ->
    ~ In e (lost w) /\
    (In e (history w) -> after e <= stored (robots w (place e))
       /\ exists m, nth_error (network w) k = Some m /\ stamp m = after e
           /\ forall gene, In gene (genes m) -> counter gene < stamp m).

Definition shipped_restart_is_safe : Prop :=
  forall l earlier r anew later e gene, told_to l (earlier ++ [Crash r anew] ++ later)%list ->
    let crashed := shipped_run l (earlier ++ [Crash r anew])%list in
    let w := shipped_run l (earlier ++ [Crash r anew] ++ later)%list in
    makes w e gene -> place e = r -> (now crashed <= time e)%nat ->
    (forall old, In old (known (robots crashed r)) -> old << gene)
    /\ (forall e', In e' (history crashed) -> place e' = r -> after e' <= counter gene)
    /\ (forall e' old, makes crashed e' old -> old <> gene).

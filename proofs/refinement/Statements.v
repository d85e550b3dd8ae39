(** * What is claimed of the C text

    For each function of [kernel.h] (translated into [Kernel.v]): whatever is in memory, it returns
    and does what the function of the model does, and touches nothing else. Nothing is assumed of
    memory but that objects that are written are apart from the others. Numbers fit their types,
    as all that a C program can hold does. *)
From Coq Require Import ZArith NArith String List Bool.
From GeneClocks Require Import Mark Clock Alignment Admission.
From Refinement Require Import Semantics Kernel.
Import ListNotations.
Open Scope string_scope.
Open Scope N_scope.

(** ** The model's values as C holds them *)

Definition number_value (n : N) : value := Int (Z.of_N n).
Definition bool_value (b : bool) : value := Int (if b then 1 else 0).
Definition mark_value (m : mark) : value :=
  Struct [("counter", number_value (counter m)); ("robot", number_value (maker m))].
Definition clock_value (c : clock) : value :=
  Struct [("next", number_value (next c)); ("durable", number_value (durable c))].
Definition limits_value (l : limits) : value :=
  Struct [("maximum", number_value (maximum l)); ("block", number_value (block l));
          ("window", number_value (window l))].

Definition fits (t : int_type) (n : N) : Prop := (Z.of_N n <= greatest t)%Z.
Definition clock_fits (c : clock) : Prop :=
  fits gene_clocks_counter (next c) /\ fits gene_clocks_counter (durable c).
Definition limits_fit (l : limits) : Prop :=
  fits gene_clocks_counter (maximum l) /\ fits gene_clocks_counter (block l)
  /\ fits gene_clocks_counter (window l).

(** A clock and its limits, at two addresses that are apart. *)
Definition clock_at (m : memory) (state limits_at : address) (c : clock) (l : limits) : Prop :=
  m state = Some (clock_value c) /\ m limits_at = Some (limits_value l) /\ state <> limits_at
  /\ clock_fits c /\ limits_fit l.

(** A genome, one element after the other. *)
Definition genome_at (m : memory) (at_ : address) (genome : list mark) : Prop :=
  fits size_t (N.of_nat (length genome)) /\
  forall k gene, nth_error genome k = Some gene ->
    m (offset at_ (Z.of_nat k)) = Some (mark_value gene).
Definition size_value (genome : list mark) : value := Int (Z.of_nat (length genome)).

(** The function calls nobody back, and whatever a callback would do does not matter. *)
Definition computes_in (rounds : nat) (function : string) (arguments : list value) (m : memory)
    (result : value) (m' : memory) : Prop :=
  forall outside, returns kernel outside rounds function arguments m result m' [].
Definition computes : string -> list value -> memory -> value -> memory -> Prop := computes_in 0.

(** True and the clock written, or false and nothing changed. *)
Definition takes_up (function : string) (arguments : list value) (m : memory) (state : address)
    (answer : option clock) : Prop :=
  match answer with
  | Some c => computes function arguments m (bool_value true) (write m state (clock_value c))
  | None => computes function arguments m (bool_value false) m
  end.

(** ** Order *)

Definition mark_ltb (a b : mark) : bool :=
  match mark_compare a b with Lt => true | _ => false end.

Definition gene_clocks_less_refines : Prop :=
  forall m a b,
    computes "gene_clocks_less" [mark_value a; mark_value b] m (bool_value (mark_ltb a b)) m.

Definition gene_clocks_equal_refines : Prop :=
  forall m a b,
    computes "gene_clocks_equal" [mark_value a; mark_value b] m (bool_value (mark_eqb a b)) m.

(** ** Clock *)

Definition gene_clocks_restore_refines : Prop :=
  forall m state limits_at old l c, clock_at m state limits_at old l -> clock_fits c ->
    takes_up "gene_clocks_restore"
      [Pointer state; Pointer limits_at; number_value (next c); number_value (durable c)]
      m state (restore l (next c) (durable c)).

Definition gene_clocks_start_refines : Prop :=
  forall m state limits_at old l, clock_at m state limits_at old l ->
    fits gene_clocks_counter (genesis_count l) ->
    takes_up "gene_clocks_start" [Pointer state; Pointer limits_at; number_value (genesis_count l)]
      m state (if genesis_count l <? maximum l then Some (Clock (start l) (start l)) else None).

Definition gene_clocks_restart_refines : Prop :=
  forall m state limits_at old l stored, clock_at m state limits_at old l ->
    fits gene_clocks_counter (genesis_count l) -> fits gene_clocks_counter stored ->
    takes_up "gene_clocks_restart"
      [Pointer state; Pointer limits_at; number_value (genesis_count l); number_value stored]
      m state (restart l stored).

Definition gene_clocks_reserve_refines : Prop :=
  forall m state limits_at c l, clock_at m state limits_at c l -> next c <= maximum l ->
    computes "gene_clocks_reserve" [Pointer state; Pointer limits_at]
      m Undefined (write m state (clock_value (reserve l c))).

(** [first] points at anything: what it holds is not read. *)
Definition gene_clocks_mint_refines : Prop :=
  forall m state limits_at first c l count, clock_at m state limits_at c l ->
    m first <> None -> first <> state -> first <> limits_at -> next c <= maximum l ->
    fits gene_clocks_counter count ->
    let arguments := [Pointer state; Pointer limits_at; number_value count; Pointer first] in
    match mint l c count with
    | Some (taken, c') =>
        computes "gene_clocks_mint" arguments m (bool_value true)
          (write (write m state (clock_value c')) first (number_value taken))
    | None => computes "gene_clocks_mint" arguments m (bool_value false) m
    end.

Definition gene_clocks_observe_refines : Prop :=
  forall m state limits_at c l stamp, clock_at m state limits_at c l ->
    fits gene_clocks_counter stamp ->
    takes_up "gene_clocks_observe" [Pointer state; Pointer limits_at; number_value stamp]
      m state (observe l c stamp).

(** ** What comes with a stamp *)

Definition covers (stamp : N) (genome : list mark) : bool :=
  forallb (fun gene => counter gene <? stamp) genome.

Definition gene_clocks_covers_refines : Prop :=
  forall m at_ genome stamp, genome_at m at_ genome ->
    computes_in (length genome) "gene_clocks_covers" [number_value stamp; Pointer at_; size_value genome]
      m (bool_value (covers stamp genome)) m.

(** How many genes come before the first that bears [robot]'s id and that it has not made. *)
Fixpoint find_unmade (next robot : N) (genome : list mark) : nat :=
  match genome with
  | [] => O
  | gene :: rest =>
      if unmade next robot gene then O else S (find_unmade next robot rest)
  end.

Definition gene_clocks_find_unmade_refines : Prop :=
  forall m at_ genome next robot, genome_at m at_ genome ->
    computes_in (length genome) "gene_clocks_find_unmade"
      [number_value next; number_value robot; Pointer at_; size_value genome]
      m (Int (Z.of_nat (find_unmade next robot genome))) m.

(** ** Allowance *)

Definition gene_clocks_earn_refines : Prop :=
  forall m allowance_at held p, m allowance_at = Some (number_value held) -> held <= ceiling p ->
    fits gene_clocks_counter (ceiling p) -> fits gene_clocks_counter (per_cycle p) ->
    computes "gene_clocks_earn"
      [Pointer allowance_at; number_value (per_cycle p); number_value (ceiling p)]
      m Undefined (write m allowance_at (number_value (earn p held))).

Definition refusal_value (why : refusal) : value :=
  Int match why with
      | BeyondMaximum => gene_clocks_beyond_maximum
      | BeyondWindow => gene_clocks_beyond_window
      | BeyondAllowance => gene_clocks_beyond_allowance
      | NotCovered => gene_clocks_gene_not_covered
      | IdentityConflict => gene_clocks_identity_conflict
      end.

Definition gene_clocks_admit_refines : Prop :=
  forall m state limits_at allowance_at c l g stamp, clock_at m state limits_at c l ->
    m allowance_at = Some (number_value (allowance g)) ->
    allowance_at <> state -> allowance_at <> limits_at ->
    fits gene_clocks_counter (allowance g) -> fits gene_clocks_counter stamp ->
    let arguments := [Pointer state; Pointer limits_at; Pointer allowance_at; number_value stamp] in
    match accept l c g stamp with
    | inl (c', g') =>
        computes "gene_clocks_admit" arguments m (Int gene_clocks_admitted)
          (write (write m state (clock_value c')) allowance_at (number_value (allowance g')))
    | inr why => computes "gene_clocks_admit" arguments m (refusal_value why) m
    end.

(** ** Alignment *)

Definition visitor_value (which : N) (context : value) : value :=
  Struct [("gene", Callback which); ("context", context)].

(** The caller's function is called with what it is told, once; what it does is its own affair. *)
Definition gene_clocks_visit_refines : Prop :=
  forall outside m visit which context match_ first second,
    m visit = Some (visitor_value which context) -> context <> Undefined ->
    let told := [context; Int match_; Int first; Int second] in
    returns kernel outside 0 "gene_clocks_visit"
      [Pointer visit; Int match_; Int first; Int second]
      m Undefined (outside which told m) [(which, told)].

(** An alignment as the visitor is told of it: how each gene stands, and how many genes of either
    genome came before. *)
Fixpoint visits (alignment : list (aligned mark)) (first second : nat) : list (Z * nat * nat) :=
  match alignment with
  | [] => []
  | Matching _ _ :: rest => (gene_clocks_matching, first, second) :: visits rest (S first) (S second)
  | Disjoint First _ :: rest =>
      (gene_clocks_disjoint_first, first, second) :: visits rest (S first) second
  | Disjoint Second _ :: rest =>
      (gene_clocks_disjoint_second, first, second) :: visits rest first (S second)
  | Excess First _ :: rest =>
      (gene_clocks_excess_first, first, second) :: visits rest (S first) second
  | Excess Second _ :: rest =>
      (gene_clocks_excess_second, first, second) :: visits rest first (S second)
  end.
Definition told (context : value) (visit : Z * nat * nat) : list value :=
  let '(match_, first, second) := visit in
  [context; Int match_; Int (Z.of_nat first); Int (Z.of_nat second)].

Definition within (at_ : address) (genome : list mark) (a : address) : Prop :=
  exists k, (k < length genome)%nat /\ a = offset at_ (Z.of_nat k).

(** The visitor may do anything, but leaves both genomes and itself alone. The two may overlap, or
    be one. *)
Definition gene_clocks_align_refines : Prop :=
  forall outside m first_at second_at first second visit which context,
    genome_at m first_at first -> genome_at m second_at second ->
    m visit = Some (visitor_value which context) -> context <> Undefined ->
    (forall arguments m a,
       within first_at first a \/ within second_at second a \/ a = visit ->
       outside which arguments m a = m a) ->
    let calls := map (told context) (visits (align (fun gene => gene) first second) 0 0) in
    returns kernel outside (length first + length second) "gene_clocks_align"
      [Pointer first_at; size_value first; Pointer second_at; size_value second; Pointer visit]
      m Undefined (fold_left (fun m arguments => outside which arguments m) calls m)
      (map (fun arguments => (which, arguments)) calls).

(** * What is claimed

    Every definition here is a statement. [proofs/] holds for each claim a theorem of the same
    name, a witness that its hypotheses can be met where its conclusion matters, and for each
    hypothesis and each rule of the protocol a counterexample without it. *)
From Coq Require Import NArith QArith List Sorting.Sorted.
From GeneClocks Require Import Mark Alignment Clock Admission Protocol Genome Recording.
From GeneClocks Require Trace Wire.
Import ListNotations.
Open Scope N_scope.

Notation do := (step gene_clocks).
Notation after_all := (run gene_clocks).

(** ** Marks *)

(** Counter first, then robot, is a strict total order. *)
Definition lt_strict_total : Prop :=
  (forall a, ~ a << a) /\ (forall a b c, a << b -> b << c -> a << c)
  /\ (forall a b, a << b \/ a = b \/ b << a) /\ (forall a b, counter a < counter b -> a << b).

(** Any two robots sort any shared set of genes in the same manner. *)
Definition sorted_form_unique : Prop :=
  forall ours theirs, sorted ours -> sorted theirs ->
    (forall m, In m ours <-> In m theirs) -> ours = theirs.

(** ** Alignment *)

Definition align_symmetric : Prop :=
  forall gene (mark_of : gene -> mark) a b, align mark_of b a = map mirror (align mark_of a b).

(** Every gene of both genomes is classified exactly once, and in the order of marks. *)
Definition align_partition : Prop :=
  forall gene (mark_of : gene -> mark) a b, let alignment := align mark_of a b in
    flat_map (genes_of First) alignment = a /\ flat_map (genes_of Second) alignment = b
    /\ (sorted (map mark_of a) -> sorted (map mark_of b) ->
        sorted (map (aligned_mark mark_of) alignment)).

Definition align_sound : Prop :=
  forall gene (mark_of : gene -> mark) a b c, sorted (map mark_of a) -> sorted (map mark_of b) ->
    In c (align mark_of a b) -> classified mark_of a b c.

Definition align_complete : Prop :=
  forall gene (mark_of : gene -> mark) a b c, sorted (map mark_of a) -> sorted (map mark_of b) ->
    classified mark_of a b c -> In c (align mark_of a b).

(** Excess lies with the genome whose last mark is the larger, and only there. *)
Definition excess_one_side : Prop :=
  forall gene (mark_of : gene -> mark) a b s, sorted (map mark_of a) -> sorted (map mark_of b) ->
    (exists x, In (Excess s x) (align mark_of a b)) <->
    (exists x, In x (own s a b) /\ forall y, In y (other s a b) -> mark_of y << mark_of x).

(** ** One clock *)

(** Exactly the stamps beyond the maximum or the admission window are refused. *)
Definition observe_admits : Prop :=
  forall l c stamp,
    observe l c stamp = None <-> maximum l < stamp \/ next c + window l < stamp.

Definition observe_is_maximum : Prop :=
  forall l c stamp c', observe l c stamp = Some c' -> next c' = N.max (next c) stamp.

(** What must be stored stays as it is while it covers the clock; else it goes a block ahead. *)
Definition reserve_is_a_block_ahead : Prop :=
  forall l c, next c <= maximum l -> next (reserve l c) = next c
    /\ (next c <= durable c -> durable (reserve l c) = durable c)
    /\ (durable c < next c -> durable (reserve l c) = N.min (next c + block l) (maximum l)).

(** A state is taken up where a clock can be in it, and only there; and no other. *)
Definition restore_admits : Prop :=
  forall l n d, (1 <= n <= d /\ d <= maximum l -> restore l n d = Some (Clock n d))
    /\ (~ (1 <= n <= d /\ d <= maximum l) -> restore l n d = None).

(** After a crash a clock goes on from what was stored; not where that lies among the genesis marks,
    as in a store made for fewer of them, nor beyond the maximum. *)
Definition restart_admits : Prop :=
  forall l s, (genesis_count l < s <= maximum l -> restart l s = Some (Clock s s))
    /\ (~ (genesis_count l < s <= maximum l) -> restart l s = None).

(** ** Safety: whatever the network, crashes, forged messages and the admission window *)

(** No two acts of creation share a mark. *)
Definition marks_unique : Prop :=
  forall l commands e1 e2 gene, valid l -> let w := after_all l commands in
    makes w e1 gene -> makes w e2 gene -> e1 = e2.

(** What happened before has the smaller mark, by the counter alone. *)
Definition clock_condition : Prop :=
  forall l commands e1 e2 a b, valid l -> let w := after_all l commands in
    makes w e1 a -> makes w e2 b -> happened_before (history w) e1 e2 -> counter a < counter b.

Definition happened_before_irreflexive : Prop :=
  forall l commands e, valid l -> ~ happened_before (history (after_all l commands)) e e.

Definition never_wraps : Prop :=
  forall l commands r, valid l -> let w := after_all l commands in let s := robots w r in
    start l <= next (memory s) <= durable (memory s) /\ durable (memory s) <= maximum l
    /\ start l <= stored s <= maximum l
    /\ (forall e gene, makes w e gene -> start l <= counter gene < maximum l)
    /\ (forall m, In m (network w) -> stamp m <= maximum l).

Definition exhaustion_is_reported : Prop :=
  forall l commands r count, valid l -> let w := after_all l commands in
    snd (do l w (Mint r count)) = Exhausted
    <-> maximum l < next (memory (robots w r)) + count.

(** Either nothing at all changes, or all [count] marks are made, and no others. *)
Definition mint_all_or_nothing : Prop :=
  forall l commands r count, valid l -> let w := after_all l commands in
    do l w (Mint r count) = (w, Exhausted) \/
    exists w' first, do l w (Mint r count) = (w', Marks first count)
      /\ next (memory (robots w' r)) = first + count
      /\ forall gene, (exists e, makes w' e gene /\ (now w <= time e)%nat)
                      <-> maker gene = r /\ first <= counter gene < first + count.

(** A new gene sorts after everything that its robot knows: insertion is appending. *)
Definition new_gene_is_last : Prop :=
  forall l commands r count w' first old new, valid l -> let w := after_all l commands in
    do l w (Mint r count) = (w', Marks first count) ->
    In old (known (robots w r)) -> first <= counter new -> old << new.

(** The shared marks of the initial genes meet no minted one. *)
Definition genesis_disjoint : Prop :=
  forall l commands e gene, valid l ->
    makes (after_all l commands) e gene -> ~ In gene (genesis l).

Definition refusal_changes_nothing : Prop :=
  forall l w c, match snd (do l w c) with
    | Refused _ | NoMessage | Exhausted | NotDurable | OutOfRange | NotResumed => fst (do l w c) = w
    | Marks _ _ | SentAs _ | Accepted | Elapsed | Persisted | Resumed => True
    end.

(** ** Durability *)

(** Nothing leaves a robot while its counter is ahead of its storage, so no crash undoes it. *)
Definition nothing_sent_is_forgotten : Prop :=
  forall l commands e k, valid l -> let w := after_all l commands in what e = Sent k ->
    ~ In e (lost w) /\
    (In e (history w) -> after e <= stored (robots w (place e))
       /\ exists m, nth_error (network w) k = Some m /\ stamp m = after e
           /\ forall gene, In gene (genes m) -> counter gene < stamp m).

(** A crash anywhere, then anything: what the robot makes from then on sorts after all that it
    has sent and kept, and repeats no mark whose making survived. *)
Definition restart_is_safe : Prop :=
  forall l earlier r anew later e gene, valid l ->
    let crashed := after_all l (earlier ++ [Crash r anew]) in
    let w := after_all l (earlier ++ [Crash r anew] ++ later) in
    makes w e gene -> place e = r -> (now crashed <= time e)%nat ->
    (forall old, In old (known (robots crashed r)) -> old << gene)
    /\ (forall e', In e' (history crashed) -> place e' = r -> after e' <= counter gene)
    /\ (forall e' old, makes crashed e' old -> old <> gene).

(** The clock comes back, whatever was stored, and stands where storage says. *)
Definition crash_is_survived : Prop :=
  forall l commands r anew, valid l -> let w := after_all l commands in
    snd (do l w (Crash r anew)) = Resumed
    /\ memory (robots (fst (do l w (Crash r anew))) r)
       = Clock (stored (robots w r)) (stored (robots w r)).

(** A snapshot of a clock gives back that very clock. *)
Definition snapshot_is_exact : Prop :=
  forall l commands r, valid l -> let c := memory (robots (after_all l commands) r) in
    restore l (next c) (durable c) = Some c.

(** ** Bounds *)

(** How far one message can move a robot. *)
Definition reach (l : limits) (s : robot) : N :=
  match guard s with
  | Some g => N.min (window l) (allowance g)
  | None => window l
  end.

(** What a command uses up, of the counters that all robots share. *)
Definition cost (l : limits) (w : world) (c : command) : N :=
  match c with
  | Mint _ count => count
  | Inject r _ => reach l (robots w r)
  | Persist r value =>  (* how far this goes beyond what is needed or stored already *)
      let s := robots w r in value - N.max (durable (memory s)) (stored s)
  | Crash r _ => block_of (robots w r)
  | Send _ _ | Receive _ _ | Overhear _ _ | Elapse _ => 0
  end.
Fixpoint spent (l : limits) (w : world) (commands : list command) : N :=
  match commands with
  | [] => 0
  | c :: rest => cost l w c + spent l (fst (do l w c)) rest
  end.
Definition budget_with_storing (l : limits) (commands : list command) : N :=
  start l + spent l (init l) commands.

(** Counters stay below genesis + genes + blocks lost to crashes + what was stored beyond need +
    the reach of forged messages. *)
Definition counter_budget : Prop :=
  forall l commands r, valid l ->
    next (memory (robots (after_all l commands) r)) <= budget_with_storing l commands.

(** And so do the stamps of messages; and what is stored, but for one block. *)
Definition stored_budget : Prop :=
  forall l commands r, valid l -> let w := after_all l commands in
    (forall m, In m (network w) -> stamp m <= budget_with_storing l commands)
    /\ stored (robots w r) <= budget_with_storing l commands + block_of (robots w r).

(** A window no smaller than all that the fleet has used refuses nobody's message, where no gate
    stands before it (so there is no room for a forged one, which costs a whole window). *)
Definition honest_never_refused : Prop :=
  forall l commands r k, valid l -> budget_with_storing l commands <= start l + window l ->
    let w := after_all l commands in
    guard (robots w r) = None -> (k < length (network w))%nat ->
    snd (do l w (Receive r k)) = Accepted.

Definition honest (commands : list command) : Prop := forall r m, ~ In (Inject r m) commands.

(** Without forged messages, every gene anywhere is an initial one or was made, and the making
    survives every crash. *)
Definition genes_have_makers : Prop :=
  forall l commands gene, valid l -> honest commands -> let w := after_all l commands in
    (exists r, In gene (known (robots w r))) \/ (exists m, In m (network w) /\ In gene (genes m)) ->
    exists_in l w gene.

(** So a robot that meets a mark of its own at or above its clock has proof of a cloned identity,
    of storage that was rolled back, or of a forged message. *)
Definition own_mark_in_past : Prop :=
  forall l commands gene, valid l -> honest commands -> let w := after_all l commands in
    (exists r, In gene (known (robots w r))) \/ (exists m, In m (network w) /\ In gene (genes m)) ->
    ~ is_genesis l gene -> counter gene < next (memory (robots w (maker gene))).

(** Checks of genes are there for forged messages: without these, the stamp alone decides. *)
Definition stamp_alone_decides : Prop :=
  forall l commands r k, valid l -> honest commands -> let w := after_all l commands in
    snd (do l w (Receive r k)) = snd (do l w (Overhear r k)).

(** ** The admission gate: whatever is heard, forged or not *)

(** One life of robot [r] behind a gate, among whatever the others do: where its clock stood at the
    beginning, and in which world it is now. *)
Definition life (l : limits) (earlier : list command) (r block : N) (p : policy)
    (later : list command) : N * world :=
  let begins := earlier ++ [Crash r (Settings block (Some p))] in
  (next (memory (robots (after_all l begins) r)), after_all l (begins ++ later)).
Definition lives_on (r : N) (later : list command) : Prop := forall anew, ~ In (Crash r anew) later.

Definition own_genes (r : N) (commands : list command) : N :=
  fold_right (fun c n => match c with Mint r' count => if r' =? r then count + n else n
                         | _ => n end) 0 commands.
Definition cycles (r : N) (commands : list command) : N :=
  fold_right (fun c n => match c with Elapse r' => if r' =? r then 1 + n else n | _ => n end)
    0 commands.

(** What a gate has earned since its robot started, spent or not. *)
Definition earned (p : policy) (r : N) (later : list command) : N :=
  initial p + per_cycle p * cycles r later.

(** However many messages there are, they advance the clock by no more than time has earned. *)
Definition allowance_bounds_clock : Prop :=
  forall l earlier r block p later, valid l -> lives_on r later ->
    let (began, w) := life l earlier r block p later in
    next (memory (robots w r)) <= began + own_genes r later + earned p r later.

(** And a stamp that lies below what time has earned is never refused for it, whatever else was heard
    before. *)
Definition allowance_admits_below : Prop :=
  forall l earlier r block p later m, valid l -> lives_on r later ->
    earned p r later <= ceiling p ->
    let (began, w) := life l earlier r block p later in
    stamp m <= began + earned p r later ->
    snd (do l w (Inject r m)) <> Refused BeyondAllowance.

(** So among honest robots a gate refuses nobody, where it has earned what the fleet has used. *)
Definition gate_never_refuses_honest : Prop :=
  forall l earlier r block p later k, valid l -> lives_on r later ->
    honest (earlier ++ later) -> earned p r later <= ceiling p ->
    let (began, w) := life l earlier r block p later in
    let budget := budget_with_storing l (earlier ++ [Crash r (Settings block (Some p))] ++ later) in
    budget <= start l + window l -> budget <= began + earned p r later ->
    (k < length (network w))%nat -> snd (do l w (Receive r k)) = Accepted.

(** A gene under the receiver's own id that the receiver never made does not pass a gate: a cloned
    identity, storage that was set back, or a forgery. *)
Definition conflict_is_refused : Prop :=
  forall l commands r m gene, let w := after_all l commands in guard (robots w r) <> None ->
    (forall other, In other (genes m) -> counter other < stamp m) ->
    In gene (genes m) -> maker gene = r -> next (memory (robots w r)) <= counter gene ->
    snd (do l w (Inject r m)) = Refused IdentityConflict.

(** ** Genomes under odNEAT's operators *)

(** Every genome is one causal chain: of any two of its genes that were made, the making of one
    happened before the making of the other. *)
Definition genome_is_chain : Prop :=
  forall l operations g a b, valid l -> let s := evolve l operations in
    in_swarm s g -> In a g -> In b g -> a <> b -> ~ is_genesis l a -> ~ is_genesis l b ->
    exists ea eb, makes (world_of s) ea a /\ makes (world_of s) eb b
      /\ (happened_before (history (world_of s)) ea eb
          \/ happened_before (history (world_of s)) eb ea).

(** So on every genome the order of marks is the order of creation; it does not approximate it. *)
Definition order_is_creation_order : Prop :=
  forall l operations g, valid l -> let s := evolve l operations in in_swarm s g ->
    sorted g /\ forall a b, In a g -> In b g -> (a << b <-> created_before l (world_of s) a b).

(** And also the order in real time, which no robot can see. *)
Definition order_is_real_time_order : Prop :=
  forall l operations g a b ea eb, valid l -> let s := evolve l operations in
    in_swarm s g -> In a g -> In b g -> makes (world_of s) ea a -> makes (world_of s) eb b ->
    (a << b <-> (time ea < time eb)%nat).

(** A child has the fitter parent's marks, in order, less those that [keep] turns away. *)
Definition crossover_keeps_fitter_marks : Prop :=
  forall gene draws (mark_of : gene -> mark) choose keep (d : draws) fitter weaker,
    (forall d a b, mark_of a = mark_of b -> mark_of (fst (choose d a b)) = mark_of a) ->
    let child := map mark_of (fst (crossover mark_of choose keep d fitter weaker)) in
    (exists which, child = map fst (filter snd (combine (map mark_of fitter) which)))
    /\ ((forall so_far a, keep so_far a = true) -> child = map mark_of fitter).

(** So do the children of odNEAT's own two crossovers, whatever is drawn. *)
Definition odneat_keeps_fitter_marks : Prop :=
  forall (fitter weaker : list connection) draws from_other,
    let is_selection (child : list connection) := exists which,
      map innovation child = map fst (filter snd (combine (map innovation fitter) which)) in
    is_selection (fst (crossover innovation choose_uniformly reverses_none draws fitter weaker))
    /\ is_selection (fst (crossover innovation choose_listed reverses_none from_other fitter weaker)).

(** Two parents, and two markings of the genes that both respect the order of creation. *)
Definition compared (l : limits) (operations : list operation) {gene} (mark_of : gene -> mark)
    (a b : list gene) (one two : mark -> mark) : Prop :=
  let s := evolve l operations in
  valid l /\ in_swarm s (map mark_of a) /\ in_swarm s (map mark_of b)
  /\ respects_creation l (world_of s) one /\ one_to_one l (world_of s) one
  /\ respects_creation l (world_of s) two /\ one_to_one l (world_of s) two.
Definition under {gene} (marking : mark -> mark) (mark_of : gene -> mark) : gene -> mark :=
  fun x => marking (mark_of x).

(** Crossover gives the same child, and uses up the same random draws, under either. *)
Definition crossover_marking_invariant : Prop :=
  forall l operations gene draws (mark_of : gene -> mark) choose keep (d : draws) a b one two,
    compared l operations mark_of a b one two ->
    crossover (under one mark_of) choose keep d a b
    = crossover (under two mark_of) choose keep d a b.

(** All that can differ is which unmatched genes count as excess rather than disjoint. *)
Definition markings_differ_in_excess_only : Prop :=
  forall l operations gene (mark_of : gene -> mark) a b one two,
    compared l operations mark_of a b one two ->
    let first := align (under one mark_of) a b in
    let second := align (under two mark_of) a b in
    matches first = matches second
    /\ (forall s x, In (Disjoint s x) first \/ In (Excess s x) first
                    <-> In (Disjoint s x) second \/ In (Excess s x) second)
    /\ (disjoint_count first + excess_count first
        = disjoint_count second + excess_count second)%nat.

(** Hence with equal coefficients for both, the same distance. *)
Definition distance_marking_invariant : Prop :=
  forall l operations gene (mark_of : gene -> mark) a b one two c1 c2 c3 size difference,
    compared l operations mark_of a b one two -> (c1 == c2)%Q ->
    (distance (under one mark_of) c1 c2 c3 size difference a b
     == distance (under two mark_of) c1 c2 c3 size difference a b)%Q.

(** Gene-clock marks are such a marking. *)
Definition gene_clock_respects_creation : Prop :=
  forall l operations, valid l -> let w := world_of (evolve l operations) in
    respects_creation l w id /\ one_to_one l w id.

(** ** Traces of real runs *)

(** In a trace that the checker accepts, no two surviving genes share a mark, and none has that
    of an initial gene … *)
Definition trace_marks_unique : Prop :=
  forall l trace i j gene, valid l -> Trace.accepted l trace ->
    Trace.mints trace i gene -> start l <= counter gene < maximum l
    /\ (Trace.mints trace j gene -> Trace.survives trace i gene -> Trace.survives trace j gene ->
        i = j).

(** … what happened before has the smaller counter … *)
Definition trace_clock_condition : Prop :=
  forall l trace i j a b, valid l -> Trace.accepted l trace ->
    Trace.trace_before trace i j -> Trace.mints trace i a -> Trace.mints trace j b ->
    (i < j)%nat /\ counter a < counter b.

(** … and no crash undid anything that had been sent. *)
Definition trace_sends_survive : Prop :=
  forall l trace i r stamp newest, valid l -> Trace.accepted l trace ->
    nth_error trace i = Some (Trace.Sends r stamp newest) ->
    newest < stamp /\ Trace.remembers trace r i (length trace) stamp.

(** No false alarms: what a run of the protocol records is accepted. *)
Definition recordings_accepted : Prop :=
  forall l commands, valid l -> honest commands -> Trace.accepted l (recording l commands).

(** ** The wire format *)

(** What is written is read as what it was … *)
Definition decode_encode : Prop :=
  forall l m frame, Wire.encode l m = Some frame -> Wire.decode l frame = Some m.

(** … and whatever is well formed and within the limits is written: 16 bytes for a neuron, 26 for a
    connection and 45 for the rest are always enough. *)
Definition encode_total : Prop :=
  forall l m, let content := Wire.content m in let genes := Wire.genes content in
    Wire.well_formed l (Wire.stamp m) genes -> Wire.fits m = true ->
    Wire.sender m <> 0 -> Wire.robot content <> 0 -> Wire.genesis_count l < Wire.stamp m ->
    Wire.within (Wire.energy m) (Wire.energy_max l) = true ->
    Wire.neurons genes <= Wire.neurons_max l -> Wire.connections genes <= Wire.connections_max l ->
    45 + 16 * Wire.neurons genes + 26 * Wire.connections genes <= Wire.frame_bytes l ->
    exists frame, Wire.encode l m = Some frame.

(** … and nothing else is read: every message has one encoding, and all other bytes are refused. *)
Definition decode_canonical : Prop :=
  forall l frame m, Wire.decode l frame = Some m -> Wire.encode l m = Some frame.

(** What is read meets what alignment and the clock ask of genes, whoever sent it. *)
Definition decoded_is_in_order : Prop :=
  forall l frame m, Wire.decode l frame = Some m -> let genes := Wire.genes (Wire.content m) in
    sorted (map Wire.mark_of genes)
    /\ Forall (fun g => let gene := Wire.mark_of g in
         1 <= counter gene < Wire.stamp m
         /\ (maker gene = 0 <-> counter gene <= Wire.genesis_count l)) genes.

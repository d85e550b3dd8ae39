(** For each claim an instance in which its hypotheses hold and its conclusion says something. *)
From Coq Require Import NArith QArith List Sorting.Sorted.
From GeneClocks Require Import Mark Alignment Clock Admission Protocol Genome Recording.
From GeneClocks Require Claims Trace Wire.
From GeneClocks.proofs Require Import Order Merge Arithmetic Invariant Safety Durability Bounds
  Provenance Allowance Chain Crossover NoFalseAlarms TraceSafety WireCodec WireTotal.
Import ListNotations.
Open Scope N_scope.

(** ** Tools *)

Ltac in_list := vm_compute; repeat first [left; reflexivity | right].
Ltac made_here := split; [in_list | reflexivity].

Definition event_at (w : world) (i : nat) : event :=
  nth i (history w) (Event 0 0 (Restarted []) 0 0).

(** What was made, where and in this order. *)
Definition made (w : world) : list mark :=
  flat_map (fun e => match what e with Minted gene => [gene] | _ => [] end) (history w).

(** ** Marks and alignment *)

Example lt_strict_total_witness : Mark 1 9 << Mark 2 3 /\ Mark 2 3 << Mark 2 7.
Proof. split; reflexivity. Qed.

Definition ours := [Mark 1 0; Mark 2 7; Mark 3 3; Mark 6 3].
Definition theirs := [Mark 1 0; Mark 2 8; Mark 3 3; Mark 4 8; Mark 7 8; Mark 7 9].

Ltac sorted_now := repeat first [apply SSorted_nil | apply SSorted_cons]; repeat constructor.

Example sorted_form_unique_witness : sorted ours /\ sorted theirs /\ ours <> theirs.
Proof. split; [sorted_now|]. split; [sorted_now | discriminate]. Qed.

(** All five classes at once. *)
Example align_partition_witness : align id ours theirs =
  [Matching (Mark 1 0) (Mark 1 0); Disjoint First (Mark 2 7); Disjoint Second (Mark 2 8);
   Matching (Mark 3 3) (Mark 3 3); Disjoint Second (Mark 4 8); Disjoint First (Mark 6 3);
   Excess Second (Mark 7 8); Excess Second (Mark 7 9)].
Proof. reflexivity. Qed.

Example align_symmetric_witness : align id theirs ours <> align id ours theirs.
Proof. discriminate. Qed.

Example align_sound_witness : In (Excess Second (Mark 7 8)) (align id ours theirs).
Proof. in_list. Qed.

Example align_complete_witness : classified id ours theirs (Disjoint First (Mark 6 3)).
Proof. apply align_sound; [sorted_now | sorted_now | in_list]. Qed.

(** The shorter genome has the excess genes where its last mark is the larger. *)
Example excess_one_side_witness :
  align id [Mark 9 1] ours = map (Disjoint Second) ours ++ [Excess First (Mark 9 1)].
Proof. reflexivity. Qed.

(** ** One clock *)

Definition small := Limits 20 3 8 1.  (* maximum, block, window, genesis marks *)

(** A robot without a gate, which reserves as the fleet does. *)
Definition plain := Settings 3 None.

Example valid_witness : valid small.
Proof. reflexivity. Qed.

Example observe_admits_witness :
  observe small (Clock 2 5) 10 = Some (Clock 10 13) /\ observe small (Clock 2 5) 11 = None
  /\ observe small (Clock 19 20) 20 = Some (Clock 20 20)
  /\ observe small (Clock 19 20) 21 = None.
Proof. repeat split. Qed.

Example observe_is_maximum_witness :
  observe small (Clock 2 5) 4 = Some (Clock 4 5) /\ observe small (Clock 4 5) 2 = Some (Clock 4 5).
Proof. split; reflexivity. Qed.

Example reserve_is_a_block_ahead_witness :
  reserve small (Clock 5 5) = Clock 5 5 /\ reserve small (Clock 6 5) = Clock 6 9
  /\ reserve small (Clock 19 18) = Clock 19 20.
Proof. repeat split. Qed.

Example restore_admits_witness : restore small 10 13 = Some (Clock 10 13)
  /\ map (fun state => restore small (fst state) (snd state)) [(0, 5); (6, 5); (20, 21)]
     = [None; None; None].
Proof. split; reflexivity. Qed.

(** A store that was made for one genesis mark does not start a robot of a fleet that has five. *)
Example restart_admits_witness : restart small 2 = Some (Clock 2 2)
  /\ map (restart (Limits 20 3 8 5)) [0; 2; 5; 21] = [None; None; None; None]
  /\ restart (Limits 20 3 8 5) 6 = Some (Clock 6 6).
Proof. repeat split; reflexivity. Qed.

(** ** A run with everything in it *)

(** Robot 7 makes three genes, stores, and sends; 3 hears it twice, and once more after a crash
    that undid the first two; 9 makes genes unheard, loses them, and is sent a forgery. *)
Definition story : list command :=
  [Mint 7 3; Send 7 []; Persist 7 8; Send 7 [Mark 2 7; Mark 4 7];
   Mint 9 2; Crash 9 plain; Mint 9 1;
   Receive 3 0; Receive 3 0; Mint 3 1; Crash 3 plain; Receive 3 0; Mint 3 3; Persist 3 8;
   Inject 9 (Message 4 [Mark 3 7]); Mint 9 1;
   Send 3 [Mark 4 7; Mark 5 3; Mark 9 9]; Receive 7 1; Mint 7 1; Crash 7 plain; Mint 7 1].
Definition told : world := after_all small story.

Example story_made : made told
  = [Mark 2 7; Mark 3 7; Mark 4 7; Mark 2 9; Mark 5 3; Mark 6 3; Mark 7 3; Mark 4 9; Mark 8 7].
Proof. vm_compute. reflexivity. Qed.

Example story_lost : map what (lost told) =
  [Minted (Mark 2 9); Minted (Mark 3 9);
   Received 0 [Mark 2 7; Mark 4 7]; Received 0 [Mark 2 7; Mark 4 7]; Minted (Mark 5 3);
   Minted (Mark 8 7)].
Proof. vm_compute. reflexivity. Qed.

(** One mark of 9 and one of 3 were made twice; the first time was lost without a trace. *)
Example marks_unique_witness : In (Mark 2 9) (made told) /\ In (Mark 5 3) (made told)
  /\ NoDup (made told).
Proof.
  split; [in_list|]. split; [in_list|]. vm_compute.
  repeat first [apply NoDup_nil | apply NoDup_cons]; cbn; intuition discriminate.
Qed.

(** Three ways in which one making happens before another: along one robot and across its crash, … *)
Example clock_condition_witness :
  exists e1 e2, makes told e1 (Mark 4 7) /\ makes told e2 (Mark 8 7)
    /\ happened_before (history told) e1 e2.
Proof.
  exists (event_at told 2), (event_at told 16).
  split; [made_here|]. split; [made_here|]. apply same_robot; [in_list | in_list | reflexivity|].
  vm_compute. repeat constructor.
Qed.

(** … by a message … *)
Example clock_condition_by_message :
  exists e1 e2, makes told e1 (Mark 3 7) /\ makes told e2 (Mark 5 3)
    /\ happened_before (history told) e1 e2.
Proof.
  exists (event_at told 1), (event_at told 8). split; [made_here|]. split; [made_here|].
  apply in_between with (event_at told 3).
  { apply same_robot; [in_list | in_list | reflexivity | vm_compute; repeat constructor]. }
  apply in_between with (event_at told 7).
  { apply same_message with (k := 0%nat) (genes := [Mark 2 7; Mark 4 7]);
      [in_list | in_list | reflexivity | reflexivity]. }
  apply same_robot; [in_list | in_list | reflexivity | vm_compute; repeat constructor].
Qed.

(** … and by a gene that a forged message brought. *)
Example clock_condition_by_gene :
  exists e1 e2, makes told e1 (Mark 3 7) /\ makes told e2 (Mark 4 9)
    /\ happened_before (history told) e1 e2.
Proof.
  exists (event_at told 1), (event_at told 12). split; [made_here|]. split; [made_here|].
  apply in_between with (event_at told 11).
  { apply same_gene with (Mark 3 7); [in_list | in_list | reflexivity | in_list|].
    vm_compute. repeat constructor. }
  apply same_robot; [in_list | in_list | reflexivity | vm_compute; repeat constructor].
Qed.

(** The converse does not hold, and nobody claims it: unrelated genes are in order too. *)
Example concurrent_genes_are_ordered_too :
  made (after_all small [Mint 7 1; Mint 3 2]) = [Mark 2 7; Mark 2 3; Mark 3 3].
Proof. vm_compute. reflexivity. Qed.

Example happened_before_irreflexive_witness : (length (history told) = 17)%nat.
Proof. vm_compute. reflexivity. Qed.

(** At the maximum the clock stops, with every counter used. *)
Definition exhausting : list command := [Mint 7 18; Mint 7 1; Mint 7 0].
Example never_wraps_witness : memory (robots (after_all small exhausting) 7) = Clock 20 20
  /\ (length (made (after_all small exhausting)) = 18)%nat.
Proof. vm_compute. split; reflexivity. Qed.

Example exhaustion_is_reported_witness :
  snd (do small (after_all small [Mint 7 16]) (Mint 7 3)) = Exhausted
  /\ snd (do small (after_all small [Mint 7 16]) (Mint 7 2)) = Marks 18 2.
Proof. vm_compute. split; reflexivity. Qed.

Example mint_all_or_nothing_witness :
  fst (do small (after_all small [Mint 7 16]) (Mint 7 3)) = after_all small [Mint 7 16]
  /\ made (fst (do small (after_all small [Mint 7 16]) (Mint 7 2)))
     = made (after_all small [Mint 7 16]) ++ [Mark 18 7; Mark 19 7].
Proof. vm_compute. split; reflexivity. Qed.

Example new_gene_is_last_witness :
  let w := after_all small [Mint 7 3; Persist 7 8; Send 7 [Mark 4 7]; Receive 3 0] in
  In (Mark 4 7) (known (robots w 3)) /\ snd (do small w (Mint 3 1)) = Marks 5 1.
Proof. split; [in_list | reflexivity]. Qed.

Example genesis_disjoint_witness : genesis small = [Mark 1 0] /\ In (Mark 2 7) (made told).
Proof. split; [reflexivity | in_list]. Qed.

Example refusal_changes_nothing_witness :
  map (fun c => snd (do small told c))
    [Receive 3 9; Inject 3 (Message 8 [Mark 8 7]); Inject 3 (Message 21 []); Inject 9 (Message 20 []);
     Mint 3 20; Send 9 []; Persist 9 21]
  = [NoMessage; Refused NotCovered; Refused BeyondMaximum; Refused BeyondWindow;
     Exhausted; NotDurable; OutOfRange].
Proof. vm_compute. reflexivity. Qed.

(** ** Durability *)

(** The first attempt to send is turned away: memory is ahead of storage. *)
Example nothing_sent_is_forgotten_witness :
  snd (do small (after_all small [Mint 7 3]) (Send 7 [])) = NotDurable
  /\ what (event_at told 3) = Sent 0 /\ (length (lost told) = 6)%nat.
Proof. vm_compute. repeat split. Qed.

(** Robot 7 dies having made ⟨8⟩ unstored; what it made before stays, and ⟨8⟩ is made anew. *)
Example restart_is_safe_witness : exists e, makes told e (Mark 8 7) /\ place e = 7
  /\ let crashed := after_all small (firstn 20 story) in
     (now crashed <= time e)%nat
     /\ robots crashed 7 = Robot (Clock 8 8) 8
          [Mark 1 0; Mark 2 7; Mark 3 7; Mark 4 7; Mark 4 7; Mark 5 3] 3 None.
Proof.
  exists (event_at told 16). split; [made_here|]. split; [reflexivity|]. split.
  - vm_compute. repeat constructor.
  - vm_compute. reflexivity.
Qed.

(** Robot 3 has stored 8, and comes back to it although it stood at 6. *)
Example crash_is_survived_witness :
  let w := after_all small [Mint 3 4; Persist 3 8; Persist 3 4] in
  memory (robots w 3) = Clock 6 9 /\ memory (robots (fst (do small w (Crash 3 plain))) 3) = Clock 8 8.
Proof. split; reflexivity. Qed.

Example snapshot_is_exact_witness : memory (robots told 9) = Clock 5 6
  /\ restore small 5 6 = Some (Clock 5 6).
Proof. vm_compute. split; reflexivity. Qed.

(** ** Bounds *)

(** The bound is met: a forged message moves the clock by the whole window, what is stored two beyond
    need by two, and the crash by a block. *)
Definition worst : list command := [Inject 7 (Message 10 []); Persist 7 15; Crash 7 plain; Mint 7 2].
Example counter_budget_witness : Claims.budget_with_storing small worst = 17
  /\ next (memory (robots (after_all small worst) 7)) = 17.
Proof. vm_compute. split; reflexivity. Qed.

(** No gene at all, but other numbers that the robot keeps by the same counter. *)
Definition numbers_genomes := [Persist 7 8; Crash 7 plain; Persist 7 14; Crash 7 plain].
Example storing_costs_witness : made (after_all small numbers_genomes) = []
  /\ next (memory (robots (after_all small numbers_genomes) 7)) = 14
  /\ Claims.budget_with_storing small numbers_genomes = start small + 6 + 3 + 6 + 3.
Proof. vm_compute. repeat split. Qed.

Definition reserving : list command := [Mint 7 1; Persist 7 6].
Example stored_budget_witness : Claims.budget_with_storing small reserving = 3
  /\ stored (robots (after_all small reserving) 7) = 6 /\ block_of (robots (after_all small reserving) 7) = 3.
Proof. vm_compute. repeat split. Qed.

(** As tight as it can be: the fleet has used all that the window allows. *)
Definition frugal : list command := [Mint 7 8; Persist 7 13; Send 7 []].
Example honest_never_refused_witness :
  Claims.budget_with_storing small frugal = start small + window small
  /\ snd (do small (after_all small frugal) (Receive 3 0)) = Accepted
  /\ next (memory (robots (fst (do small (after_all small frugal) (Receive 3 0))) 3)) = 10.
Proof. vm_compute. repeat split. Qed.

Definition honest_story : list command := filter (fun c =>
  match c with Inject _ _ => false | _ => true end) story.
Lemma honest_story_honest : Claims.honest honest_story.
Proof. intros r m J. apply filter_In in J as [_ J]. discriminate. Qed.

(** After its crash robot 3 still knows the initial gene, made by nobody, and others' genes. *)
Example genes_have_makers_witness :
  known (robots (after_all small honest_story) 7)
  = [Mark 1 0; Mark 2 7; Mark 3 7; Mark 4 7; Mark 4 7; Mark 5 3; Mark 8 7].
Proof. vm_compute. reflexivity. Qed.

Example own_mark_in_past_witness :
  In (Mark 5 3) (known (robots (after_all small honest_story) 7))
  /\ next (memory (robots (after_all small honest_story) 3)) = 8.
Proof. split; [in_list | reflexivity]. Qed.

(** Robots reserve as far ahead as each likes, and anew in each life. *)
Example blocks_differ :
  let w := after_all small [Crash 7 (Settings 6 None); Mint 7 1; Mint 9 1; Crash 9 (Settings 0 None); Mint 9 2] in
  map (fun r => memory (robots w r)) [7; 9; 3] = [Clock 3 9; Clock 4 4; Clock 2 2].
Proof. vm_compute. reflexivity. Qed.

(** With its genes or without, a message is accepted alike, and refused alike. *)
Example stamp_alone_decides_witness :
  let w := after_all small (honest_story ++ [Mint 7 7; Persist 7 20; Send 7 [Mark 9 7]]) in
  map (fun c => snd (do small w c)) [Receive 3 1; Overhear 3 1; Receive 9 2; Overhear 9 2]
  = [Accepted; Accepted; Refused BeyondWindow; Refused BeyondWindow].
Proof. vm_compute. reflexivity. Qed.

(** ** The admission gate *)

Definition paced := Policy 2 3 100.  (* initial, per cycle, ceiling *)
Definition forged (at_stamp : N) : command := Inject 9 (Message at_stamp []).

(** The bound is met: strangers take all that is earned as soon as it is, and no more. *)
Definition besieged : list command :=
  [forged 5; forged 4; Elapse 9; Elapse 3; forged 9; forged 7; Mint 9 1; Mint 3 2; forged 9].
Example allowance_bounds_clock_witness :
  let (began, w) := Claims.life small [] 9 3 paced besieged in
  began = 2 /\ next (memory (robots w 9)) = 8
  /\ began + Claims.own_genes 9 besieged + Claims.earned paced 9 besieged = 8.
Proof. vm_compute. repeat split. Qed.

(** What was too early is heard after two quiet cycles, and nothing above the line is. *)
Definition quiet : list command := [forged 4; Elapse 9; Elapse 9].
Example allowance_admits_below_witness :
  let (began, w) := Claims.life small [] 9 3 paced quiet in
  began + Claims.earned paced 9 quiet = 10
  /\ snd (do small (snd (Claims.life small [] 9 3 paced [forged 4])) (forged 10))
     = Refused BeyondAllowance
  /\ snd (do small w (forged 10)) = Accepted /\ snd (do small w (forged 11)) = Refused BeyondAllowance.
Proof. vm_compute. repeat split. Qed.

(** As tight as it can be: what robot 7 has used is what the gate of robot 9 has earned. *)
Definition lean := Limits 20 0 8 1.
Definition heard_at_last : list command := [Mint 7 8; Persist 7 10; Send 7 [Mark 9 7]; Elapse 9; Elapse 9].
Example gate_never_refuses_honest_witness :
  let begins := [Crash 9 (Settings 0 (Some paced))] in
  Claims.budget_with_storing lean (begins ++ heard_at_last) = 10
  /\ start lean + window lean = 10 /\ 2 + Claims.earned paced 9 heard_at_last = 10
  /\ snd (do lean (after_all lean (begins ++ heard_at_last)) (Receive 9 0)) = Accepted
  /\ snd (do lean (after_all lean (begins ++ firstn 4 heard_at_last)) (Receive 9 0))
     = Refused BeyondAllowance.
Proof. vm_compute. repeat split. Qed.

(** A mark of robot 9, which has made none: behind a gate it is refused, without one believed. *)
Example conflict_is_refused_witness :
  let m := Message 4 [Mark 2 9] in
  snd (do small (snd (Claims.life small [] 9 3 paced [])) (Inject 9 m)) = Refused IdentityConflict
  /\ snd (do small (init small) (Inject 9 m)) = Accepted.
Proof. split; reflexivity. Qed.

(** ** Genomes *)

(** Robot 7 adds a neuron and sends; 3 adds a connection to what it hears, and so does 9, which
    stores, is sent 3's genome, and crosses it with its own. *)
Definition family : list operation :=
  [AddGenes 7 0 3; Store 7 8; Broadcast 7 1;
   Deliver 3 0; Deliver 9 0; AddGenes 3 1 1; AddGenes 9 1 1; AddGenes 3 2 1; Store 3 8; Broadcast 3 3;
   Deliver 9 1; Recombine 9 2 3 (fun _ _ => true); Recombine 9 3 2 (fun _ gene => counter gene <? 6);
   Store 9 5; Fail 9 plain; Deliver 9 1; AddGenes 9 2 1].
Definition family_genome := [Mark 1 0; Mark 2 7; Mark 3 7; Mark 4 7].
Definition thirds := family_genome ++ [Mark 5 3; Mark 6 3].
Definition ninths := thirds ++ [Mark 7 9].

Example family_at_the_end : held (evolve small family) 9 =
  [[Mark 1 0]; family_genome; thirds; ninths].
Proof. vm_compute. reflexivity. Qed.

(** Before the crash of 9: its two children by crossover, the second of which left genes out. *)
Example family_before_the_crash : skipn 3 (held (evolve small (firstn 13 family)) 9) =
  [thirds; family_genome ++ [Mark 5 9]; family_genome ++ [Mark 5 3]].
Proof. vm_compute. reflexivity. Qed.

Lemma ninths_in_swarm : in_swarm (evolve small family) ninths.
Proof. left. exists 9. vm_compute. tauto. Qed.

Lemma thirds_in_swarm : in_swarm (evolve small family) thirds.
Proof. left. exists 9. vm_compute. tauto. Qed.

(** Genes of three robots on one genome, and a crash on the way. *)
Example genome_is_chain_witness : In (Mark 4 7) ninths /\ In (Mark 6 3) ninths
  /\ exists ea eb, makes (world_of (evolve small family)) ea (Mark 4 7)
       /\ makes (world_of (evolve small family)) eb (Mark 6 3)
       /\ happened_before (history (world_of (evolve small family))) ea eb.
Proof.
  split; [in_list|]. split; [in_list|].
  apply (chain_before small family valid_witness ninths);
    [exact ninths_in_swarm | in_list | in_list | reflexivity | |];
    intros G; apply in_genesis in G; destruct G; discriminate.
Qed.

Example order_is_creation_order_witness :
  created_before small (world_of (evolve small family)) (Mark 6 3) (Mark 7 9).
Proof.
  apply (order_is_creation_order small family ninths valid_witness ninths_in_swarm);
    [in_list | in_list | reflexivity].
Qed.

Example order_is_real_time_order_witness :
  map (fun e => (time e, what e)) (filter (fun e => match what e with Minted _ => true | _ => false end)
    (history (world_of (evolve small family))))
  = [(0, Minted (Mark 2 7)); (1, Minted (Mark 3 7)); (2, Minted (Mark 4 7));
     (6, Minted (Mark 5 3)); (8, Minted (Mark 6 3)); (13, Minted (Mark 7 9))]%nat.
Proof. vm_compute. reflexivity. Qed.

(** A gene with a weight; the coin that picks the copy is the head of a list. *)
Definition weighted := (mark * Z)%type.
Definition coin (flips : list bool) (a b : weighted) : weighted * list bool :=
  match flips with true :: rest => (b, rest) | false :: rest => (a, rest) | [] => (a, []) end.
Definition with_weight (z : Z) (g : genome) : list weighted := map (fun m => (m, z)) g.

Example crossover_keeps_fitter_marks_witness :
  crossover fst coin (fun _ _ => true) [false; true; true; false; true]
    (with_weight 1 ours) (with_weight 2 theirs)
  = ([(Mark 1 0, 1%Z); (Mark 2 7, 1%Z); (Mark 3 3, 2%Z); (Mark 6 3, 1%Z)], [true; false; true]).
Proof. vm_compute. reflexivity. Qed.

(** A feed-forward connection, its reversal, and one of the other parent's own. The draws: the first
    weight is the other's, and what one parent has disabled stays so; the second is the fitter's. *)
Definition forth := Connection (Mark 2 7) (Mark 1 0) (Mark 3 0) false 5%Z true.
Definition back := Connection (Mark 4 7) (Mark 3 0) (Mark 1 0) false 6%Z true.
Definition forth_elsewhere := Connection (Mark 2 7) (Mark 1 0) (Mark 3 0) false (-5)%Z false.
Definition elsewhere := Connection (Mark 6 9) (Mark 1 0) (Mark 1 0) true 1%Z true.
Example odneat_keeps_fitter_marks_witness :
  crossover innovation choose_uniformly reverses_none [(true, false); (false, true); (true, true)]
    [forth; back] [forth_elsewhere; elsewhere]
  = ([reweighted forth (-5)%Z false], [(true, true)])
  /\ crossover innovation choose_listed reverses_none [false] [forth; back] [forth_elsewhere; elsewhere]
     = ([forth], []).
Proof. split; reflexivity. Qed.

(** Fitness decides; at a tie the smaller, then the second. *)
Example fitter_witness : map (fun p => is_first_fitter (fst (fst p)) (snd (fst p)) (fst (snd p)) (snd (snd p)))
    [((2, 1)%Z, (9, 1)%nat); ((1, 2)%Z, (1, 9)%nat); ((1, 1)%Z, (1, 2)%nat); ((1, 1)%Z, (2, 2)%nat)]
  = [true; false; true; false].
Proof. reflexivity. Qed.

(** One pair is enabled in both. *)
Example weight_terms_witness :
  let pairs := [(forth, forth_elsewhere); (back, elsewhere); (back, back)] in
  (weight_sum 10 pairs == 1#2)%Q /\ (weight_mean 10 pairs == 1#4)%Q.
Proof. split; reflexivity. Qed.

(** Two robots at work unheard; the same genes marked by gene clocks, and by the time at which
    they were made. *)
Definition apart : list operation := [AddGenes 2 0 2; AddGenes 1 0 1].
Definition by_time (gene : mark) : mark :=
  match gene with
  | Mark 2 1 => Mark 4 0
  | Mark c _ => Mark c 0
  end.
Definition of_one := [Mark 1 0; Mark 2 1].
Definition of_two := [Mark 1 0; Mark 2 2; Mark 3 2].

Lemma apart_exists gene : exists_in small (world_of (evolve small apart)) gene ->
  In gene [Mark 1 0; Mark 2 2; Mark 3 2; Mark 2 1].
Proof.
  intros [G|(e & J & W)].
  - apply in_genesis in G. destruct gene as [c r]. cbn in G. destruct G as [-> G].
    assert (c = 1) as -> by (destruct G; apply N.le_antisymm; assumption). now left.
  - vm_compute in J. destruct J as [<-|[<-|[<-|[]]]]; injection W as <-; cbn; tauto.
Qed.

(** The genes of the two robots are unrelated; the one made last is not the cause of the others. *)
Lemma apart_unrelated b : In b [Mark 2 2; Mark 3 2] ->
  ~ created_before small (world_of (evolve small apart)) (Mark 2 1) b.
Proof.
  intros B [(A & _)|[(A & _)|(ea & eb & (A & A') & (E & E') & H)]];
    try (apply in_genesis in A; destruct A; discriminate).
  apply (before_mono small) in H as (_ & _ & T & _); [|now apply (evolved small apart)].
  vm_compute in A, E. destruct A as [<-|[<-|[<-|[]]]]; try discriminate.
  destruct E as [<-|[<-|[<-|[]]]].
  - vm_compute in T. repeat apply le_S_n in T. inversion T.
  - vm_compute in T. repeat apply le_S_n in T. inversion T.
  - injection E' as <-. destruct B as [B|[B|[]]]; discriminate.
Qed.

Lemma apart_compared : Claims.compared small apart id of_one of_two id by_time.
Proof.
  destruct (gene_clock_respects_creation small apart valid_witness) as (R & U).
  split; [exact valid_witness|]. split; [left; exists 1; vm_compute; tauto|].
  split; [left; exists 2; vm_compute; tauto|]. split; [exact R|]. split; [exact U|]. split.
  - intros a b C. assert (L := R a b C). unfold id in L.
    assert (E : exists_in small (world_of (evolve small apart)) a /\
                exists_in small (world_of (evolve small apart)) b).
    { destruct C as [(A & B & _)|[(A & e & B)|(ea & eb & A & B & _)]]; split;
        solve [left; assumption | right; eexists; eassumption]. }
    destruct E as (A & B). apply apart_exists in A, B. assert (No := apart_unrelated b).
    destruct A as [<-|[<-|[<-|[<-|[]]]]], B as [<-|[<-|[<-|[<-|[]]]]]; try reflexivity;
      try discriminate L; exfalso; apply No; [in_list | exact C | in_list | exact C].
  - intros a b A B. apply apart_exists in A, B.
    destruct A as [<-|[<-|[<-|[<-|[]]]]], B as [<-|[<-|[<-|[<-|[]]]]];
      reflexivity || discriminate.
Qed.

Example crossover_marking_invariant_witness :
  crossover id (fun d a _ => (a, d)) (fun _ _ => true) tt of_two of_one = (of_two, tt)
  /\ crossover by_time (fun d a _ => (a, d)) (fun _ _ => true) tt of_two of_one = (of_two, tt).
Proof. split; reflexivity. Qed.

(** The two markings do differ, and just where the claim says. *)
Example markings_differ_in_excess_only_witness :
  align id of_one of_two =
    [Matching (Mark 1 0) (Mark 1 0);
     Disjoint First (Mark 2 1); Excess Second (Mark 2 2); Excess Second (Mark 3 2)]
  /\ align by_time of_one of_two =
    [Matching (Mark 1 0) (Mark 1 0);
     Disjoint Second (Mark 2 2); Disjoint Second (Mark 3 2); Excess First (Mark 2 1)].
Proof. split; reflexivity. Qed.

(** 0.5 · 1 excess / 4 + 1.5 · 2 disjoint / 4 + 0.4 · 3 *)
Example distance_witness :
  (distance by_time (1#2) (3#2) (2#5) 4 (fun pairs => Z.of_nat (length pairs) * 3 # 1) of_one of_two
   == 83#40)%Q.
Proof. reflexivity. Qed.

(** So with the paper's own coefficients for the two, the distances differ; with equal ones not. *)
Example distance_marking_invariant_witness :
  (~ distance id (1#2) (3#2) 0 1 (fun _ => 0) of_one of_two
     == distance by_time (1#2) (3#2) 0 1 (fun _ => 0) of_one of_two)%Q
  /\ (distance id 1 1 0 1 (fun _ => 0) of_one of_two
      == distance by_time 1 1 0 1 (fun _ => 0) of_one of_two)%Q.
Proof. split; [discriminate | reflexivity]. Qed.

Example gene_clock_respects_creation_witness :
  created_before small (world_of (evolve small apart)) (Mark 2 2) (Mark 3 2).
Proof.
  apply (order_is_creation_order small apart of_two valid_witness);
    [left; exists 2; vm_compute; tauto | in_list | in_list | reflexivity].
Qed.

(** ** Traces *)

Definition recorded : list Trace.entry :=
  [Trace.Mints 7 2 3; Trace.Stores 7 8; Trace.Sends 7 5 4;
   Trace.Mints 9 2 2; Trace.Restarts 9 2; Trace.Mints 9 2 1;
   Trace.Receives 3 0 5; Trace.Receives 3 0 5; Trace.Mints 3 5 1; Trace.Restarts 3 2;
   Trace.Receives 3 0 5; Trace.Mints 3 5 3; Trace.Stores 3 8; Trace.Mints 9 3 1;
   Trace.Sends 3 8 5; Trace.Receives 7 1 8; Trace.Mints 7 8 1; Trace.Restarts 7 8; Trace.Mints 7 8 1].

Example recordings_accepted_witness :
  recording small honest_story = recorded /\ Trace.accepted small recorded.
Proof.
  assert (E : recording small honest_story = recorded) by (vm_compute; reflexivity).
  split; [exact E|]. rewrite <- E.
  exact (recordings_accepted small honest_story valid_witness honest_story_honest).
Qed.

(** The mark ⟨8, 7⟩ is there twice; the first did not survive. *)
Example trace_marks_unique_witness :
  Trace.mints recorded 16 (Mark 8 7) /\ Trace.mints recorded 18 (Mark 8 7)
  /\ ~ Trace.survives recorded 16 (Mark 8 7) /\ Trace.survives recorded 18 (Mark 8 7).
Proof.
  split; [|split; [|split]].
  - exists 8, 1. split; [reflexivity | now split].
  - exists 8, 1. split; [reflexivity | now split].
  - intros S. specialize (S 17%nat 8 ltac:(vm_compute; split; repeat constructor) eq_refl).
    vm_compute in S. now apply S.
  - intros k value (B & _) E. assert (k < length recorded)%nat
      by (apply nth_error_Some; congruence).
    vm_compute in H. exfalso. apply (PeanoNat.Nat.lt_irrefl 18).
    now apply PeanoNat.Nat.lt_le_trans with k; [|apply le_S_n].
Qed.

Example trace_clock_condition_witness : Trace.trace_before recorded 0 11.
Proof.
  assert (R : forall r i j n, (forall k value, nth_error recorded k = Some (Trace.Restarts r value) ->
            (k <= i)%nat \/ (j < k)%nat \/ n <= value) -> Trace.remembers recorded r i j n).
  { intros r i j n H k value (A & B) E. destruct (H k value E) as [|[|]]; auto;
      exfalso; [apply (PeanoNat.Nat.lt_irrefl k) | apply (PeanoNat.Nat.lt_irrefl j)].
    - eapply PeanoNat.Nat.le_lt_trans; eauto.
    - eapply PeanoNat.Nat.lt_le_trans; eauto. }
  apply Trace.trace_in_between with 2%nat.
  - apply Trace.trace_same_robot with 7 5 5; [now split | now split | repeat constructor|].
    apply R. intros k value E.
    do 19 (destruct k as [|k]; [vm_compute in E; try discriminate; right; left; repeat constructor|]).
    destruct k; discriminate.
  - apply Trace.trace_in_between with 10%nat.
    + apply Trace.trace_same_message with 7 5 4 3 5; reflexivity.
    + apply Trace.trace_same_robot with 3 5 8; [now split | now split | repeat constructor|].
      apply R. intros k value E.
      do 11 (destruct k as [|k]; [left; repeat constructor|]).
      do 8 (destruct k as [|k]; [vm_compute in E; try discriminate; right; left; repeat constructor|]).
      destruct k; discriminate.
Qed.

Example trace_sends_survive_witness : nth_error recorded 2 = Some (Trace.Sends 7 5 4)
  /\ nth_error recorded 17 = Some (Trace.Restarts 7 8).
Proof. split; reflexivity. Qed.

(** ** The wire format *)

(** A perceptron of two inputs that robot 7 has split, as docs/wire-format.md shows it. *)
Definition wire_limits := Wire.Limits 400 5 12 12 1128792064 1092616192.
Definition sent_message : Wire.message :=
  let connection c r source target weight :=
    Wire.Gene (Mark c r) (Wire.Connection true false source target weight) in
  let neuron c r kind := Wire.Gene (Mark c r) (Wire.Neuron kind) in
  Wire.Message 7 9 1112014848 (Wire.Genome 7 0
    [neuron 1 0 Wire.Input; neuron 2 0 Wire.Bias; neuron 3 0 Wire.Output;
     connection 4 0 0 2 1056964608; connection 5 0 1 2 3196059648;
     neuron 6 7 Wire.Hidden; connection 7 7 0 3 1065353216; connection 8 7 3 2 1056964608]).
Definition without_sum : list N :=
  [1; 7; 9; 0; 0; 72; 66; 37; 7; 0; 4; 4; 16; 18; 20; 19; 0; 2; 0; 0; 0; 63; 19; 1; 2; 0; 0; 128;
   190; 30; 7; 19; 0; 3; 0; 0; 128; 63; 19; 3; 2; 0; 0; 0; 63].
Definition sent_frame : list N := without_sum ++ [39; 108; 11; 44].

Example decode_encode_witness : Wire.encode wire_limits sent_message = Some sent_frame.
Proof. vm_compute. reflexivity. Qed.

(** The same genome, split once more by robot 9, and its frame. *)
Definition two_hidden : list Wire.gene := Wire.genes (Wire.content sent_message) ++
  [Wire.Gene (Mark 9 9) (Wire.Neuron Wire.Hidden);
   Wire.Gene (Mark 10 9) (Wire.Connection true false 1 4 1065353216);
   Wire.Gene (Mark 11 9) (Wire.Connection true false 4 2 3196059648)].
Definition of_two_hidden := Wire.Message 9 12 1112014848 (Wire.Genome 9 3 two_hidden).

Lemma two_hidden_well_formed : Wire.well_formed wire_limits 12 two_hidden.
Proof.
  split.
  - cbn. sorted_now.
  - repeat constructor; cbn; try discriminate; intros H; exfalso; now (discriminate H || apply H).
  - exists (firstn 1 two_hidden), (nth 1 two_hidden (Wire.Gene (Mark 0 0) (Wire.Neuron Wire.Input))),
      (firstn 1 (skipn 2 two_hidden)), (skipn 3 two_hidden).
    split; [reflexivity|]. do 3 (split; [repeat constructor|]). split; [discriminate|]. split.
    + repeat (apply Forall_cons; [solve [left; reflexivity | right; repeat eexists]|]).
      apply Forall_nil.
    + intros before g after source target E Ends. vm_compute in E.
      do 8 (destruct before as [|? before]; cbn [app] in E;
        [injection E as <- _; cbn in Ends; try discriminate Ends; injection Ends as <- <-;
         vm_compute; repeat split; discriminate || reflexivity
        | injection E as <- E]).
      destruct before; discriminate.
  - cbn. repeat constructor; cbn; intuition discriminate.
  - repeat constructor.
Qed.

Example encode_total_witness : exists frame, Wire.encode wire_limits of_two_hidden = Some frame
  /\ Wire.decode wire_limits frame = Some of_two_hidden.
Proof.
  destruct (encode_total wire_limits of_two_hidden two_hidden_well_formed) as (frame & E);
    try reflexivity; try discriminate.
  exists frame. split; [exact E|]. now apply decode_encode.
Qed.

Example decode_canonical_witness : Wire.decode wire_limits sent_frame = Some sent_message.
Proof. vm_compute. reflexivity. Qed.

Example decoded_is_in_order_witness :
  map Wire.mark_of (Wire.genes (Wire.content sent_message))
  = [Mark 1 0; Mark 2 0; Mark 3 0; Mark 4 0; Mark 5 0; Mark 6 7; Mark 7 7; Mark 8 7].
Proof. reflexivity. Qed.

(** What goes wrong without each rule of the protocol, and without each hypothesis of a claim. *)
From Coq Require Import NArith QArith List.
From GeneClocks Require Import Mark Alignment Clock Admission Protocol Genome Recording.
From GeneClocks Require Claims Trace Wire.
From GeneClocks.proofs Require Import Order Invariant Witnesses.
Import ListNotations.
Open Scope N_scope.

Definition tight : limits := Limits 20 0 20 1.  (* no block, no window to speak of *)
Definition bare : settings := Settings 0 None.

(** Two makings, the first of which happened before the second, in a world. *)
Ltac related w i j := exists (event_at w i), (event_at w j); split; [made_here|]; split; [made_here|].
Ltac along_robot := apply same_robot;
  [in_list | in_list | reflexivity | vm_compute; repeat constructor].
Ltac by_message number := eapply same_message with (k := number);
  [in_list | in_list | reflexivity | reflexivity].
Ltac by_gene brought := apply same_gene with (gene := brought);
  [in_list | in_list | reflexivity | in_list | vm_compute; repeat constructor].

(** In [w], the making of [a] happened before that of [b]. *)
Definition made_before (w : world) (a b : mark) : Prop := exists ea eb,
  makes w ea a /\ makes w eb b /\ happened_before (history w) ea eb.

(** ** One rule broken at a time *)

(** The last counter used is sent, not the next unused one: a tie, and the cause sorts second. *)
Definition sends_last_used : rules := {|
  stamp_of c := next c - 1; merge := merge gene_clocks; credible := credible gene_clocks; gated := gated gene_clocks;
  may_send := may_send gene_clocks; resume := resume gene_clocks; retains := retains gene_clocks |}.

Example sends_last_used_fails :
  let w := run sends_last_used tight [Mint 7 1; Persist 7 3; Send 7 []; Receive 3 0; Mint 3 1] in
  made_before w (Mark 2 7) (Mark 2 3) /\ Mark 2 3 << Mark 2 7.
Proof.
  intros w. split; [|reflexivity]. related w 0%nat 3%nat. apply in_between with (event_at w 1); [along_robot|].
  apply in_between with (event_at w 2); [by_message 0%nat | along_robot].
Qed.

(** The robot before the counter, as the paper writes the pair. *)
Definition robot_first (a b : mark) : Prop :=
  maker a < maker b \/ maker a = maker b /\ counter a < counter b.

Example robot_first_fails :
  let w := after_all tight [Mint 7 1; Persist 7 3; Send 7 [Mark 2 7]; Receive 3 0; Mint 3 1] in
  made_before w (Mark 2 7) (Mark 3 3) /\ robot_first (Mark 3 3) (Mark 2 7).
Proof.
  intros w. split; [|now left]. related w 0%nat 3%nat. apply in_between with (event_at w 1); [along_robot|].
  apply in_between with (event_at w 2); [by_message 0%nat | along_robot].
Qed.

(** A genome is accepted, but its stamp is not merged. *)
Definition without_merge : rules := {|
  stamp_of := stamp_of gene_clocks; merge _ c _ := Some c; credible := credible gene_clocks; gated := gated gene_clocks;
  may_send := may_send gene_clocks; resume := resume gene_clocks; retains := retains gene_clocks |}.

Example without_merge_fails :
  let w := run without_merge tight
             [Mint 7 2; Persist 7 4; Send 7 [Mark 3 7]; Receive 3 0; Mint 3 1] in
  made_before w (Mark 3 7) (Mark 2 3) /\ In (Mark 3 7) (known (robots w 3)).
Proof.
  intros w. split; [|in_list]. related w 1%nat 4%nat. apply in_between with (event_at w 2); [along_robot|].
  apply in_between with (event_at w 3); [by_message 0%nat | along_robot].
Qed.

(** A message is believed whatever its genes: a forger need only name a gene above its stamp. *)
Definition credulous : rules := {|
  stamp_of := stamp_of gene_clocks; merge := merge gene_clocks; credible _ := true; gated := gated gene_clocks;
  may_send := may_send gene_clocks; resume := resume gene_clocks; retains := retains gene_clocks |}.

Example credulous_fails :
  let w := run credulous tight [Mint 7 2; Inject 3 (Message 2 [Mark 3 7]); Mint 3 1] in
  made_before w (Mark 3 7) (Mark 2 3).
Proof.
  intros w. related w 1%nat 3%nat. apply in_between with (event_at w 2); [by_gene (Mark 3 7) | along_robot].
Qed.

(** Messages leave before the flush: the sender dies, and makes another gene with the same mark. *)
Definition sends_before_flush : rules := {|
  stamp_of := stamp_of gene_clocks; merge := merge gene_clocks; credible := credible gene_clocks; gated := gated gene_clocks;
  may_send _ := true; resume := resume gene_clocks; retains := retains gene_clocks |}.

Example sends_before_flush_fails :
  let w := run sends_before_flush tight
             [Mint 7 1; Send 7 [Mark 2 7]; Receive 3 0; Crash 7 bare; Mint 7 1] in
  map what (lost w) = [Minted (Mark 2 7); Sent 0] /\ In (Mark 2 7) (made w)
  /\ In (Mark 2 7) (known (robots w 3)).
Proof. split; [reflexivity|]. split; in_list. Qed.

(** Only what is minted is stored, not what is merged: block reservation must cover both. *)
Definition merges_unreserved : rules := {|
  stamp_of := stamp_of gene_clocks; credible := credible gene_clocks; gated := gated gene_clocks;
  merge l c stamp := option_map (fun c' => Clock (next c') (durable c)) (observe l c stamp);
  may_send := may_send gene_clocks; resume := resume gene_clocks; retains := retains gene_clocks |}.

Example merges_unreserved_fails :
  let w := run merges_unreserved tight
    [Mint 7 2; Persist 7 4; Send 7 [Mark 3 7]; Receive 3 0; Send 3 [Mark 3 7]; Crash 3 bare; Mint 3 1] in
  map what (lost w) = [Received 0 [Mark 3 7]; Sent 1] /\ In (Mark 2 3) (made w).
Proof. split; [reflexivity | in_list]. Qed.

(** The counter is not stored at all. *)
Definition volatile_counter : rules := {|
  stamp_of := stamp_of gene_clocks; merge := merge gene_clocks; credible := credible gene_clocks; gated := gated gene_clocks;
  may_send := may_send gene_clocks; resume l _ := restart l (start l);
  retains := retains gene_clocks |}.

Example volatile_counter_fails :
  made (run volatile_counter tight [Mint 7 1; Persist 7 3; Crash 7 bare; Mint 7 1])
  = [Mark 2 7; Mark 2 7].
Proof. reflexivity. Qed.

(** A restart does not know how many genesis marks there are: a store that was made for one of them, in
    a fleet that has five. The new gene sorts among the initial ones. *)
Definition forgets_genesis : rules := {|
  stamp_of := stamp_of gene_clocks; merge := merge gene_clocks; credible := credible gene_clocks; gated := gated gene_clocks;
  may_send := may_send gene_clocks; resume l stored := restore l stored stored;
  retains := retains gene_clocks |}.

Example forgets_genesis_fails :
  let l := Limits 20 0 20 5 in
  let fresh := init l in
  let other_store := World 0 (update (robots fresh) 7 (Robot (Clock 2 2) 2 [] 0 None)) [] [] [] in
  made (fst (step forgets_genesis l (fst (step forgets_genesis l other_store (Crash 7 bare))) (Mint 7 1)))
  = [Mark 2 7]
  /\ snd (do l other_store (Crash 7 bare)) = NotResumed.
Proof. split; reflexivity. Qed.

(** A stored genome is kept although it holds a mark above the restored counter. *)
Definition hoards : rules := {|
  stamp_of := stamp_of gene_clocks; merge := merge gene_clocks; credible := credible gene_clocks; gated := gated gene_clocks;
  may_send := may_send gene_clocks; resume := resume gene_clocks; retains _ _ := true |}.

Example hoards_fails :
  let w := run hoards tight
    [Mint 7 2; Persist 7 4; Send 7 [Mark 3 7]; Receive 3 0; Crash 3 bare; Mint 3 1] in
  made_before w (Mark 3 7) (Mark 2 3).
Proof.
  intros w. related w 1%nat 4%nat. apply in_between with (event_at w 3); [by_gene (Mark 3 7) | along_robot].
Qed.

(** ** One hypothesis dropped at a time *)

(** [valid]: no room between the genesis marks and the maximum. *)
Definition cramped : limits := Limits 5 0 5 5.
Example valid_is_needed : ~ durable (memory (robots (init cramped) 7)) <= maximum cramped.
Proof. vm_compute. intros H. now apply H. Qed.

(** [sorted], in [sorted_form_unique] and in alignment. *)
Example sorted_is_needed : (forall m, In m [Mark 1 0; Mark 2 7] <-> In m [Mark 2 7; Mark 1 0])
  /\ [Mark 1 0; Mark 2 7] <> [Mark 2 7; Mark 1 0].
Proof. split; [cbn; tauto | discriminate]. Qed.

Example sorted_is_needed_to_align :
  align id [Mark 2 1; Mark 1 1] [Mark 1 1]
  = [Disjoint Second (Mark 1 1); Excess First (Mark 2 1); Excess First (Mark 1 1)].
Proof. reflexivity. Qed.

(** [reserve_is_a_block_ahead] below the maximum only: beyond it, what is stored lags behind. *)
Example below_maximum_is_needed : reserve tight (Clock 21 0) = Clock 21 20.
Proof. reflexivity. Qed.

(** A wide window: one forged message exhausts its receiver and, by gossip, the swarm … *)
Example wide_window_is_exhausted :
  let w := after_all tight [Inject 7 (Message 20 []); Persist 7 20; Send 7 []; Receive 3 0] in
  snd (do tight w (Mint 7 1)) = Exhausted /\ snd (do tight w (Mint 3 1)) = Exhausted.
Proof. split; reflexivity. Qed.

(** … a narrow one shuts out an honest robot that was away for long … *)
Example narrow_window_shuts_out :
  let l := Limits 20 0 2 1 in
  let commands := [Mint 7 3; Persist 7 5; Send 7 []] in
  Claims.budget_with_storing l commands = start l + window l + 1
  /\ snd (do l (after_all l commands) (Receive 3 0)) = Refused BeyondWindow.
Proof. split; reflexivity. Qed.

(** … and a crash costs a block of it, each time. *)
Example crashes_shut_out :
  let l := Limits 20 2 2 1 in
  snd (do l (after_all l [Mint 7 1; Persist 7 5; Crash 7 bare; Send 7 []]) (Receive 3 0)) = Refused BeyondWindow.
Proof. reflexivity. Qed.

(** … and so does what is stored beyond need. Here no gene is ever made: the robot has numbered eight
    genomes by the same counter. A gate that was set for genes alone refuses it as well, until … *)
Example storing_shuts_out :
  let l := Limits 20 0 20 1 in
  let commands := [Crash 3 (Settings 0 (Some (Policy 2 1 100))); Persist 7 10; Crash 7 bare; Send 7 []] in
  made (after_all l commands) = []
  /\ next (memory (robots (after_all l commands) 7)) = 10
  /\ snd (do l (after_all l commands) (Receive 3 0)) = Refused BeyondAllowance
  (** … time has caught up. *)
  /\ snd (do l (after_all l (commands ++ repeat (Elapse 3) 6)) (Receive 3 0)) = Accepted.
Proof. vm_compute. repeat split. Qed.

(** What a budget without the cost of storing would say is false of this robot. *)
Example budget_without_storing_is_false :
  let l := Limits 20 0 20 1 in
  let commands := [Persist 7 10; Crash 7 bare] in
  let without := fold_right (fun c total => match c with Mint _ n => n | Crash _ _ => block l
                                            | _ => 0 end + total) (start l) commands in
  without = 2 /\ next (memory (robots (after_all l commands) 7)) = 10
  /\ Claims.budget_with_storing l commands = 10.
Proof. vm_compute. repeat split. Qed.

(** [lives_on]: a restart gives a gate its initial allowance again. *)
Example lives_on_is_needed :
  let p := Policy 2 0 100 in
  let later := [Inject 9 (Message 4 []); Persist 9 4; Crash 9 (Settings 0 (Some p)); Inject 9 (Message 6 [])] in
  let (began, w) := Claims.life tight [] 9 0 p later in
  began + Claims.own_genes 9 later + Claims.earned p 9 later = 4 /\ next (memory (robots w 9)) = 6.
Proof. vm_compute. split; reflexivity. Qed.

(** An allowance that saturates loses what it would have earned. *)
Example ceiling_is_needed :
  let p := Policy 2 2 3 in
  let later := [Elapse 9; Elapse 9; Elapse 9] in
  let (began, w) := Claims.life tight [] 9 0 p later in
  began + Claims.earned p 9 later = 10
  /\ snd (do tight w (Inject 9 (Message 6 []))) = Refused BeyondAllowance.
Proof. vm_compute. split; reflexivity. Qed.

(** [honest]: a forged message brings genes that nobody made, and marks from a robot's future. *)
Example honest_is_needed :
  let w := after_all tight [Inject 3 (Message 10 [Mark 9 7])] in
  In (Mark 9 7) (known (robots w 3)) /\ made w = [] /\ next (memory (robots w 7)) = 2.
Proof. split; [in_list|]. split; reflexivity. Qed.

(** … and a robot that believed one passes it on, so that its receivers look at genes for good reason. *)
Example honest_is_needed_without_genes :
  let w := after_all tight [Crash 7 (Settings 0 (Some (Policy 20 0 20))); Inject 3 (Message 10 [Mark 9 7]);
                            Persist 3 10; Send 3 [Mark 9 7]] in
  snd (do tight w (Receive 7 0)) = Refused IdentityConflict
  /\ snd (do tight w (Overhear 7 0)) = Accepted.
Proof. vm_compute. split; reflexivity. Qed.

(** A trace does not show forged messages, so the checker sees their effect as a fault. *)
Example honest_is_needed_to_record :
  Trace.check_trace tight (recording tight [Inject 3 (Message 10 []); Mint 3 1])
  = inr (0%nat, Trace.NotNextCounter).
Proof. reflexivity. Qed.

(** ** Other operators *)

(** Disjoint genes of both parents, as NEAT takes them at equal fitness: the child's genes were
    made by robots that knew nothing of each other, and no order of creation joins them. *)
Definition from_both (a b : genome) : genome := map (aligned_mark id) (align id a b).

Example from_both_is_no_chain :
  from_both of_one of_two = [Mark 1 0; Mark 2 1; Mark 2 2; Mark 3 2]
  /\ ~ made_before (world_of (evolve small apart)) (Mark 2 1) (Mark 2 2)
  /\ ~ made_before (world_of (evolve small apart)) (Mark 2 2) (Mark 2 1).
Proof.
  split; [reflexivity|].
  (* no event gives one robot anything of the other's *)
  assert (Apart : forall e1 e2, happened_before (history (world_of (evolve small apart))) e1 e2 ->
            place e1 = place e2).
  { intros e1 e2 H. induction H as [|e1 e2 k gs _ J _ R|e1 e2 gene _ J _ B|]; auto; [| |congruence];
      vm_compute in J; destruct J as [<-|[<-|[<-|[]]]]; discriminate || destruct B. }
  split; intros (ea & eb & (A & A') & (B & B') & H); apply Apart in H;
    vm_compute in A, B; destruct A as [<-|[<-|[<-|[]]]]; try discriminate;
    destruct B as [<-|[<-|[<-|[]]]]; discriminate.
Qed.

(** ** Other markings *)

(** A marking against the order of creation, as clocks that drift may give: a matching gene is
    missed. *)
Definition drifting (gene : mark) : mark :=
  match gene with Mark 2 2 => Mark 9 2 | other => other end.
Example respects_creation_is_needed :
  matches (align id of_two [Mark 1 0; Mark 3 2]) = [(Mark 1 0, Mark 1 0); (Mark 3 2, Mark 3 2)]
  /\ matches (align drifting of_two [Mark 1 0; Mark 3 2]) = [(Mark 1 0, Mark 1 0)].
Proof. split; reflexivity. Qed.

(** A marking that gives two genes the same number, as random identifiers may: strangers match. *)
Definition colliding (gene : mark) : mark := Mark (counter gene) 0.
Example one_to_one_is_needed :
  matches (align id of_one of_two) = [(Mark 1 0, Mark 1 0)]
  /\ matches (align colliding of_one of_two)
     = [(Mark 1 0, Mark 1 0); (Mark 2 1, Mark 2 2)].
Proof. split; reflexivity. Qed.

(** A choice between matching genes that changes their mark. *)
Example choice_keeps_marks_is_needed :
  fst (crossover id (fun (d : unit) _ _ => (Mark 9 9, d)) (fun _ _ => true) tt of_one of_two)
  = [Mark 9 9; Mark 2 1].
Proof. reflexivity. Qed.

(** Unequal coefficients: see [Witnesses.distance_marking_invariant_witness]. *)

(** ** Faulty traces: each rule of the checker refuses something *)

Definition after_one_send := [Trace.Mints 7 2 3; Trace.Stores 7 8; Trace.Sends 7 5 4].
Definition found (trace : list Trace.entry) : nat * option Trace.violation :=
  match Trace.check_trace small trace with
  | inl _ => (length trace, None)
  | inr (position, violation) => (position, Some violation)
  end.

Example each_fault_is_found : map (fun e => found (after_one_send ++ [e]))
  [Trace.Mints 7 4 1; Trace.Mints 7 6 1; Trace.Mints 7 5 16; Trace.Sends 7 4 3; Trace.Sends 7 5 5;
   Trace.Receives 3 1 5; Trace.Receives 3 0 6; Trace.Receives 3 0 2; Trace.Stores 7 7; Trace.Stores 7 21;
   Trace.Restarts 7 5; Trace.Restarts 3 8; Trace.Mints 7 5 15]
  = [(3, Some Trace.NotNextCounter); (3, Some Trace.NotNextCounter); (3, Some Trace.MintedBeyondMaximum);
     (3, Some Trace.WrongStamp); (3, Some Trace.GeneAboveStamp);
     (3, Some Trace.NoSuchMessage); (3, Some Trace.WrongMaximum); (3, Some Trace.WrongMaximum);
     (3, Some Trace.StoredBackwards); (3, Some Trace.StoredBackwards);
     (3, Some Trace.WrongRestart); (3, Some Trace.WrongRestart); (4, None)]%nat.
Proof. reflexivity. Qed.

Example sending_unstored_is_found :
  found [Trace.Mints 7 2 3; Trace.Sends 7 5 4] = (1%nat, Some Trace.SentBeforeStored).
Proof. reflexivity. Qed.

Example leaping_is_found :
  found [Trace.Mints 7 2 10; Trace.Stores 7 12; Trace.Sends 7 12 11; Trace.Receives 3 0 12]
  = (3%nat, Some Trace.NotAdmitted).
Proof. reflexivity. Qed.

(** ** Frames that are not: each rule of the format refuses something *)

(** The witness's frame with some bytes replaced from a place on, under a checksum of its own. *)
Definition damaged (place : nat) (before after : list N) : list N :=
  let body := firstn place without_sum ++ after ++ skipn (place + length before) without_sum in
  body ++ Wire.put_word 4 (Wire.crc32c body).
Definition is_refused (frame : list N) : bool :=
  match Wire.decode wire_limits frame with None => true | Some _ => false end.

Example an_undamaged_frame_is_read : is_refused (damaged 1 [7] [7]) = false.
Proof. vm_compute. reflexivity. Qed.

Example a_wrong_checksum_is_refused : is_refused (without_sum ++ [39; 108; 11; 45]) = true.
Proof. vm_compute. reflexivity. Qed.

Example trailing_bytes_are_refused : is_refused (sent_frame ++ [0]) = true.
Proof. vm_compute. reflexivity. Qed.

Example each_damage_is_refused :
  forallb is_refused
    [damaged 0 [1] [2];                        (* another version *)
     damaged 1 [7] [0];                        (* the reserved robot as sender *)
     damaged 1 [7] [135; 0];                   (* a longer encoding of the same sender *)
     damaged 2 [9] [5];                        (* a stamp among the genesis marks *)
     damaged 2 [9] [8];                        (* a stamp that is not above all genes *)
     damaged 3 [0; 0; 72; 66] [0; 0; 192; 127];  (* no number for an energy *)
     damaged 3 [0; 0; 72; 66] [1; 0; 72; 67];  (* an energy beyond the limit *)
     damaged 7 [37] [36];                      (* a payload length that is too small *)
     damaged 8 [7] [0];                        (* a genome by the reserved robot *)
     damaged 10 [4] [13];                      (* more neurons than the limit *)
     damaged 10 [4; 4] [3; 5];                 (* a connection announced where a neuron is *)
     damaged 12 [16] [0];                      (* a mark that is not above the one before *)
     damaged 12 [16; 18] [18; 16];             (* an input after the bias *)
     damaged 13 [18] [16];                     (* no bias *)
     damaged 14 [20] [22];                     (* no output *)
     damaged 16 [0; 2] [4; 2];                 (* a source that does not exist *)
     damaged 16 [0; 2] [0; 1];                 (* a connection into the bias *)
     damaged 16 [0; 2] [1; 2];                 (* the ends of another connection *)
     damaged 18 [0; 0; 0; 63] [0; 0; 128; 127];  (* an infinite weight *)
     damaged 29 [30; 7] [22];                  (* an initial gene beyond the genesis marks *)
     damaged 30 [7] [0];                       (* a robot that is given again *)
     damaged 31 [19] [3]]                      (* the mark of the neuron before it *)
  = true.
Proof. vm_compute. reflexivity. Qed.

(** [well_formed]: a genome without an output has no encoding, nor has one whose connection ends in the
    bias, one with two connections between the same neurons, or one that is beyond the limits. *)
Definition encodes (genes : list Wire.gene) : bool :=
  match Wire.encode wire_limits (Wire.Message 9 12 1112014848 (Wire.Genome 9 3 genes)) with
  | Some _ => true | None => false end.
Definition another (source target : N) : list Wire.gene :=
  two_hidden ++ [Wire.Gene (Mark 11 10) (Wire.Connection true false source target 0)].
Example well_formed_is_needed :
  map encodes [two_hidden; another 3 4; firstn 2 two_hidden; another 3 1; another 4 2; another 5 2;
               two_hidden ++ repeat (Wire.Gene (Mark 11 10) (Wire.Neuron Wire.Hidden)) 2]
  = [true; true; false; false; false; false; false].
Proof. vm_compute. reflexivity. Qed.

(** Limits may be infinite; numbers may not. *)
Example infinity_is_never_within : map (fun bits => Wire.within bits (255 * 2 ^ 23))
  [255 * 2 ^ 23 - 1; 255 * 2 ^ 23; 511 * 2 ^ 23; 2 ^ 31 - 1; 2 ^ 32 - 1]
  = [true; false; false; false; false].
Proof. reflexivity. Qed.

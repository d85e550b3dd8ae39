(** Under odNEAT's operators every genome is one causal chain. *)
From Coq Require Import NArith PeanoNat List Bool Lia.
From GeneClocks Require Import Mark Alignment Clock Admission Protocol Genome.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order Arithmetic Invariant Safety Provenance Crossover.
Import ListNotations.
Open Scope N_scope.

(** ** The swarm's world is a run of the protocol without forged messages *)

Definition reachable (l : limits) (w : world) : Prop :=
  exists commands, Claims.honest commands /\ w = after_all l commands.

Lemma reachable_init l : reachable l (init l).
Proof. exists []. split; [intros r m []| reflexivity]. Qed.

Lemma reachable_step l w c : reachable l w -> (forall r m, c <> Inject r m) ->
  reachable l (fst (do l w c)).
Proof.
  intros (commands & Honest & ->) C. exists (commands ++ [c]). rewrite run_snoc. split; auto.
  intros r m J. apply in_app_or in J as [J|[J|[]]]; [exact (Honest r m J) | exact (C r m J)].
Qed.

Lemma reachable_invariant l w : valid l -> reachable l w -> invariant l w /\ provenance l w.
Proof.
  intros Valid (commands & Honest & ->). split; [now apply run_invariant | now apply run_provenance].
Qed.

(** ** Chains *)

(** [ea] is at the robot of [eb], or a gene of it came there, before [eb]. *)
Definition known_at (w : world) (ea eb : event) (gene : mark) : Prop :=
  place ea = place eb \/
  exists e, In e (history w) /\ brings e gene /\ (time ea < time e)%nat
    /\ place e = place eb /\ (time e < time eb)%nat.

Definition chained (l : limits) (w : world) (g : genome) : Prop :=
  sorted g /\ forall a b, In a g -> In b g -> a << b -> ~ is_genesis l a -> ~ is_genesis l b ->
    exists ea eb, makes w ea a /\ makes w eb b /\ known_at w ea eb a.

(** Every gene is an initial one or was made. *)
Definition real (l : limits) (w : world) (g : genome) : Prop :=
  forall a, In a g -> exists_in l w a.

Lemma known_at_before l w ea eb a b : invariant l w -> makes w ea a -> makes w eb b -> a << b ->
  known_at w ea eb a -> happened_before (history w) ea eb.
Proof.
  intros I (Ja & Wa) (Jb & Wb) L [P|(e & J & B & T & P & T')].
  - apply same_robot; auto. destruct (Nat.lt_trichotomy (time ea) (time eb)) as [|[E|H]]; auto.
    + apply (one_event_a_time l w I) in E; auto. subst. rewrite Wa in Wb. injection Wb as ->.
      destruct (mark_lt_irreflexive _ L).
    + assert (O := robot_order l w I eb ea Jb Ja (eq_sym P) H).
      destruct (minting l w ea a I (conj Ja Wa)) as (-> & ? & _).
      destruct (minting l w eb b I (conj Jb Wb)) as (-> & ? & _).
      apply mark_lt_iff in L. cbn in L. lia.
  - apply in_between with e; [eapply same_gene; eauto | now apply same_robot].
Qed.

(** What happens next does not undo a chain whose genes still have makers. *)
Lemma chained_step l w c g : invariant l w -> invariant l (fst (do l w c)) ->
  real l (fst (do l w c)) g -> chained l w g -> chained l (fst (do l w c)) g.
Proof.
  intros I I' Real (S & Chain). split; auto. intros a b A B L Ga Gb.
  destruct (Chain a b A B L Ga Gb) as (ea & eb & Ma & Mb & K).
  assert (Kept : forall e, In e (history w) -> In e (history (fst (do l w c))) \/
            exists r anew, c = Crash r anew /\ place e = r /\ stored (robots w r) < after e).
  { intros e J. assert (Hear : forall r m how,
              In e (history (fst (hear gene_clocks l w r m how)))).
    { intros r m how. destruct (hear_cases l w r m how) as [(new & _ & ->)|(why & ->)]; auto.
      apply in_or_app. auto. }
    destruct c as [r count|r selection|r k|r k|r m|r|r value|r anew]; cbn [step].
    - destruct (mint _ _ _) as [[? ?]|]; left; auto. apply in_or_app. auto.
    - destruct (may_send _ _); left; auto. apply in_or_app. auto.
    - destruct (nth_error _ k) as [m|]; left; auto.
    - destruct (nth_error _ k) as [m|]; left; auto.
    - left. auto.
    - left. apply in_or_app. auto.
    - destruct (value <=? _); left; auto. apply in_or_app. auto.
    - rewrite resumes by apply (robots_ok l w I). cbn. destruct (undone w r e) eqn:U.
      + right. exists r, anew. unfold undone in U. apply andb_prop in U as [P L'].
        apply N.eqb_eq in P. apply N.ltb_lt in L'. auto.
      + left. apply in_or_app. left. apply filter_In. now rewrite U. }
  assert (Same : forall x ex, In x g -> ~ is_genesis l x -> makes w ex x ->
            makes (fst (do l w c)) ex x).
  { intros x ex X Gx Mx. destruct (Real x X) as [|(e & M)]; [tauto|].
    destruct (Kept ex (proj1 Mx)) as [J|(r & anew & -> & P & L')]; [split; auto; apply Mx|].
    exfalso. destruct M as (J & W). cbn [step] in J. rewrite resumes in J by apply (robots_ok l w I).
    cbn in J. apply in_app_or in J as [J|[<-|[]]]; [|discriminate].
    apply filter_In in J as (J & U). assert (e = ex) as ->.
    { eapply (made_once l w); eauto. split; auto. }
    unfold undone in U. apply N.eqb_eq in P. apply N.ltb_lt in L'. now rewrite P, L' in U. }
  exists ea, eb. split; [now apply Same|]. assert (Mb' : makes (fst (do l w c)) eb b) by now apply Same.
  split; auto. destruct K as [|(e & J & Br & T & P & T')]; [now left | right].
  exists e. repeat split; auto.
  destruct (Kept e J) as [|(r & anew & -> & P' & L')]; auto. exfalso.
  assert (O := robot_order l w I e eb J (proj1 Mb) P T').
  destruct (minting l w eb b I Mb) as (_ & A' & _).
  destruct Mb' as (J' & W'). cbn [step] in J'.
  rewrite resumes in J' by apply (robots_ok l w I). cbn in J'. apply in_app_or in J' as [J'|[<-|[]]]; [|discriminate].
  apply filter_In in J' as (_ & U). unfold undone in U. rewrite <- P, P', N.eqb_refl in U. cbn in U.
  destruct (N.ltb_spec (stored (robots w r)) (after eb)); [discriminate | lia].
Qed.

Lemma chained_selection l w g which : chained l w g -> chained l w (selection g which).
Proof.
  intros (S & C). split; [now apply selection_sorted|].
  intros a b A B. apply selection_in in A, B. now apply C.
Qed.

(** ** The invariant of a swarm *)

Definition swarm_ok (l : limits) (s : swarm) : Prop :=
  reachable l (world_of s)
  /\ (forall r g, In g (held s r) -> chained l (world_of s) g
        /\ forall a, In a g -> In a (known (robots (world_of s) r)))
  /\ (forall m, In m (network (world_of s)) -> chained l (world_of s) (genes m)).

Lemma genesis_sorted l : sorted (genesis l).
Proof.
  unfold genesis. generalize (N.to_nat (genesis_count l)), 1%nat. intros n.
  induction n as [|n IH]; intros first; cbn; [constructor|]. apply sorted_cons_iff.
  split; [apply IH|]. intros m J. apply in_map_iff in J as (i & <- & J). apply in_seq in J.
  apply counter_decides. cbn. lia.
Qed.

Lemma minted_sorted r first n : sorted (minted_marks r first n).
Proof.
  unfold minted_marks. generalize 0%nat. induction n as [|n IH]; intros i; cbn; [constructor|].
  apply sorted_cons_iff. split; [apply IH|]. intros m J. apply in_map_iff in J as (j & <- & J).
  apply in_seq in J. apply counter_decides. cbn. lia.
Qed.

(** A mutation appends to a genome that its robot holds. *)
Lemma chained_mutation l w r count w' first parent : reachable l w -> valid l ->
  do l w (Mint r count) = (w', Marks first count) ->
  chained l w parent -> (forall a, In a parent -> In a (known (robots w r))) ->
  chained l w' parent -> chained l w' (parent ++ minted_marks r first (N.to_nat count)).
Proof.
  intros R Valid Do (S & C) K (_ & C').
  destruct (reachable_invariant l w Valid R) as (I & (Known & _)).
  assert (R' : reachable l w').
  { replace w' with (fst (do l w (Mint r count))) by now rewrite Do.
    apply reachable_step; auto. discriminate. }
  destruct (reachable_invariant l w' Valid R') as (I' & _).
  destruct R as (commands & _ & E).
  assert (Fresh : forall a b, In a parent -> In b (minted_marks r first (N.to_nat count)) -> a << b).
  { intros a b A B. apply in_minted_marks in B as (_ & B & _).
    assert (New := new_gene_is_last l commands r count w' first a b Valid). cbn zeta in New.
    rewrite <- E in New. auto. }
  split. { apply sorted_app. auto using minted_sorted. }
  assert (Made : forall b, In b (minted_marks r first (N.to_nat count)) ->
            exists eb, makes w' eb b /\ place eb = r /\ (now w <= time eb)%nat).
  { intros b B. apply in_minted_marks in B as (P & B).
    destruct (mint_all_or_nothing l commands r count Valid) as [X|(w'' & f & X & _ & Made)];
      rewrite <- E in X; rewrite Do in X; [discriminate|]. injection X as <- <-.
    destruct (proj2 (Made b)) as (eb & Mb & T); [rewrite N2Nat.id in B; auto|].
    exists eb. rewrite <- E in T. repeat split; auto; try apply Mb.
    destruct (minting l w' eb b I' Mb) as (Q & _). rewrite Q in P. exact P. }
  assert (History : forall e, In e (history w) -> In e (history w')).
  { intros e J. replace w' with (fst (do l w (Mint r count))) by now rewrite Do.
    cbn [step]. destruct (mint _ _ _) as [[? ?]|]; auto. apply in_or_app. auto. }
  intros a b A B L Ga Gb. apply in_app_or in A as [A|A], B as [B|B].
  - now apply C'.
  - destruct (Made b B) as (eb & Mb & P & T).
    destruct (Known r a (K a A)) as [|(ea & (Ja & Wa) & O)]; [tauto|].
    exists ea, eb. split; [split; auto|]. split; auto.
    destruct O as [O|(_ & e & J & P' & Br & T')]; [left; congruence | right].
    exists e. repeat split; auto; try congruence. destruct (events_past l w I e J). lia.
  - destruct (mark_lt_asymmetric _ _ L (Fresh b a B A)).
  - destruct (Made a A) as (ea & Ma & Pa & _), (Made b B) as (eb & Mb & Pb & _).
    exists ea, eb. repeat split; try apply Ma; try apply Mb. left. congruence.
Qed.

(** The world moves by one command, and robots keep the genomes that they knew how to keep. *)
Lemma swarm_step l s c : valid l -> swarm_ok l s -> (forall r m, c <> Inject r m) ->
  let w' := fst (do l (world_of s) c) in
  reachable l w'
  /\ (forall r g, In g (held s r) -> (forall a, In a g -> In a (known (robots w' r))) ->
        chained l w' g)
  /\ (forall m, In m (network (world_of s)) -> chained l w' (genes m)).
Proof.
  intros Valid (R & Held & Net) Honest w'.
  assert (R' : reachable l w') by now apply reachable_step.
  destruct (reachable_invariant l _ Valid R) as (I & _).
  destruct (reachable_invariant l _ Valid R') as (I' & P').
  assert (Network : forall m, In m (network (world_of s)) -> In m (network w')).
  { intros m M. subst w'. assert (Hear : forall r m' how,
              In m (network (fst (hear gene_clocks l (world_of s) r m' how)))).
    { intros r m' how. destruct (hear_cases l (world_of s) r m' how) as [(new & _ & ->)|(why & ->)];
        auto. apply in_or_app. auto. }
    destruct c as [r count|r selection|r k|r k|r m'|r|r value|r anew]; cbn [step].
    - destruct (mint _ _ _) as [[? ?]|]; auto. apply in_or_app. auto.
    - destruct (may_send _ _); auto. apply in_or_app. auto.
    - destruct (nth_error _ k); auto.
    - destruct (nth_error _ k); auto.
    - auto.
    - apply in_or_app. auto.
    - destruct (value <=? _); auto. apply in_or_app. auto.
    - rewrite resumes by apply (robots_ok l _ I). exact M. }
  split; [exact R'|]. split.
  - intros r g G K. destruct (Held r g G) as (C & _). apply chained_step; auto.
    intros a A. apply (provenance_exists l w'); auto. left. exists r. auto.
  - intros m M. apply chained_step; auto. intros a A.
    apply (provenance_exists l w'); auto. right. exists m. auto.
Qed.

(** One more genome in the hands of [r]. *)
Lemma hold_ok l w (genomes : N -> list genome) r g :
  (forall r' g', In g' (genomes r') -> chained l w g'
     /\ forall a, In a g' -> In a (known (robots w r'))) ->
  chained l w g -> (forall a, In a g -> In a (known (robots w r))) ->
  forall r' g', In g' (hold genomes r g r') -> chained l w g'
     /\ forall a, In a g' -> In a (known (robots w r')).
Proof.
  intros Held C K r' g'. unfold hold. destruct (N.eqb_spec r' r) as [->|]; [|apply Held].
  intros G. apply in_app_or in G as [G|[<-|[]]]; auto.
Qed.

(** A command after which all robots still know what they knew. *)
Lemma swarm_step_keeping l s c : valid l -> swarm_ok l s -> (forall r m, c <> Inject r m) ->
  let w' := fst (do l (world_of s) c) in
  (forall r a, In a (known (robots (world_of s) r)) -> In a (known (robots w' r))) ->
  (forall m, In m (network w') -> In m (network (world_of s)) \/ chained l w' (genes m)) ->
  swarm_ok l (Swarm w' (held s)).
Proof.
  intros Valid Ok Honest w' Known Network.
  destruct (swarm_step l s c Valid Ok Honest) as (R & Held & Net).
  split; [exact R|]. cbn [world_of held]. split.
  - intros r g G. assert (K := proj2 (proj1 (proj2 Ok) r g G)). split; [apply (Held r)|]; auto.
  - intros m M. destruct (Network m M); auto.
Qed.

Lemma add_genes_ok l s r i count : valid l -> swarm_ok l s ->
  swarm_ok l (operate l s (AddGenes r i count)).
Proof.
  intros Valid Ok. cbn [operate].
  destruct (nth_error (held s r) i) as [parent|] eqn:P; [|exact Ok]. apply nth_error_In in P.
  destruct (do l (world_of s) (Mint r count)) as (w', answer) eqn:Do.
  destruct answer as [first count'| | | | | | | | | | |]; try exact Ok.
  assert (W : w' = fst (do l (world_of s) (Mint r count))) by now rewrite Do.
  destruct (proj1 (proj2 Ok) r parent P) as (C & K).
  assert (Effect : count' = count /\ network w' = network (world_of s)
    /\ known (robots w' r) = known (robots (world_of s) r)
                             ++ minted_marks r first (N.to_nat count)
    /\ forall r', r' <> r -> robots w' r' = robots (world_of s) r').
  { cbn [step] in Do. destruct (mint _ _ _) as [[f c]|]; [|discriminate].
    injection Do as <- <- <-. cbn. rewrite app_nil_r, update_same. repeat split; auto.
    intros r' Ne. now apply update_other. }
  destruct Effect as (-> & Net & Known & Others).
  assert (Ok' : swarm_ok l (Swarm w' (held s))).
  { rewrite W in *. apply swarm_step_keeping; auto; [discriminate | |].
    - intros r' a A. destruct (N.eq_dec r' r) as [->|Ne]; [|now rewrite Others].
      rewrite Known. apply in_or_app. auto.
    - rewrite Net. auto. }
  destruct Ok' as (R' & Held' & Net'). split; [exact R'|]. split; [|exact Net'].
  cbn [world_of held] in *. apply hold_ok; auto.
  - apply (chained_mutation l (world_of s) r count w' first parent); auto; [apply Ok|].
    apply (Held' r parent P).
  - intros a A. rewrite Known. apply in_app_or in A as [A|A]; apply in_or_app; auto.
Qed.

Lemma recombine_ok l s r i j keep : swarm_ok l s -> swarm_ok l (operate l s (Recombine r i j keep)).
Proof.
  intros Ok. cbn [operate]. destruct Ok as (R & Held & Net).
  destruct (nth_error (held s r) i) as [fitter|] eqn:F; [|split; auto].
  destruct (nth_error (held s r) j) as [weaker|]; [|split; auto].
  apply nth_error_In in F. destruct (Held r fitter F) as (C & K).
  destruct (crossover_keeps_fitter_marks mark unit id (fun d a _ => (a, d)) keep tt fitter weaker)
    as ((which & E) & _); [reflexivity|]. rewrite !map_id in E.
  fold (selection fitter which) in E. rewrite E.
  split; [exact R|]. split; [|exact Net]. cbn [world_of held]. apply hold_ok; auto.
  - now apply chained_selection.
  - intros a A. apply K. now apply selection_in in A.
Qed.

Lemma filter_all {A} (f : A -> bool) l : (forall a, In a l -> f a = true) -> filter f l = l.
Proof.
  induction l as [|a l IH]; intros H; auto. cbn. rewrite (H a) by now left. f_equal. apply IH.
  intros b B. apply H. now right.
Qed.

Lemma broadcast_ok l s r i : valid l -> swarm_ok l s -> swarm_ok l (operate l s (Broadcast r i)).
Proof.
  intros Valid Ok. cbn [operate].
  destruct (nth_error (held s r) i) as [g|] eqn:G; [|exact Ok]. apply nth_error_In in G.
  destruct (proj1 (proj2 Ok) r g G) as (C & K).
  destruct (swarm_step l s (Send r g) Valid Ok) as (_ & Held & _); [discriminate|].
  apply swarm_step_keeping; auto; [discriminate | |].
  - intros r' a A. cbn [step]. destruct (may_send _ _); auto. cbn.
    unfold update. now destruct (N.eqb_spec r' r) as [->|].
  - intros m M. cbn [step] in M, Held |- *.
    destruct (may_send gene_clocks (robots (world_of s) r)); [|now left].
    cbn in M. apply in_app_or in M as [M|[<-|[]]]; [now left | right]. cbn [genes].
    rewrite filter_all; [|intros a A; now apply knows_in, K].
    apply (Held r); auto. intros a A. cbn. rewrite update_same. now apply K.
Qed.

Lemma deliver_ok l s r k : valid l -> swarm_ok l s -> swarm_ok l (operate l s (Deliver r k)).
Proof.
  intros Valid Ok. cbn [operate].
  destruct (nth_error (network (world_of s)) k) as [m|] eqn:M; [|exact Ok].
  destruct (do l (world_of s) (Receive r k)) as (w', answer) eqn:Do.
  destruct answer; try exact Ok.
  assert (W : w' = fst (do l (world_of s) (Receive r k))) by now rewrite Do.
  assert (Effect : network w' = network (world_of s)
    /\ known (robots w' r) = known (robots (world_of s) r) ++ genes m
    /\ forall r', r' <> r -> robots w' r' = robots (world_of s) r').
  { cbn [step] in Do. rewrite M in Do.
    destruct (hear_cases l (world_of s) r m (Received k (genes m)))
      as [(new & L & E)|(why & E)]; rewrite E in Do; [|discriminate]. injection Do as <-. cbn.
    rewrite app_nil_r, update_same. repeat split; [|intros r' Ne; now apply update_other].
    destruct (reachable_invariant l _ Valid (proj1 Ok)) as (I & _).
    now apply (learn_some l) in L as (_ & _ & ? & _); [|apply (robots_ok l _ I)]. }
  destruct Effect as (Net & Known & Others).
  assert (Ok' : swarm_ok l (Swarm w' (held s))).
  { rewrite W in *. apply swarm_step_keeping; auto; [discriminate | |].
    - intros r' a A. destruct (N.eq_dec r' r) as [->|Ne]; [|now rewrite Others].
      rewrite Known. apply in_or_app. auto.
    - rewrite Net. auto. }
  destruct Ok' as (R' & Held' & Net'). split; [exact R'|]. split; [|exact Net'].
  cbn [world_of held] in *. apply hold_ok; auto.
  - apply Net'. rewrite Net. now apply nth_error_In in M.
  - intros a A. rewrite Known. apply in_or_app. auto.
Qed.

Lemma listen_ok l s r k : valid l -> swarm_ok l s -> swarm_ok l (operate l s (Listen r k)).
Proof.
  intros Valid Ok. destruct (reachable_invariant l _ Valid (proj1 Ok)) as (I & _).
  apply swarm_step_keeping; auto; [discriminate | |]; cbn [step];
    (destruct (nth_error (network (world_of s)) k) as [m|]; [|now auto]);
    destruct (hear_cases l (world_of s) r (Message (stamp m) []) (Received k []))
      as [(new & L & ->)|(why & ->)]; auto.
  - intros r' a A. apply (learn_some l) in L as (_ & _ & K & _); [|apply (robots_ok l _ I)].
    cbn. unfold update. destruct (N.eqb_spec r' r) as [->|]; auto. rewrite K. apply in_or_app. auto.
  - intros m' J. cbn in J. rewrite app_nil_r in J. now left.
Qed.

Lemma wait_ok l s r : valid l -> swarm_ok l s -> swarm_ok l (operate l s (Wait r)).
Proof.
  intros Valid Ok. apply swarm_step_keeping; auto; [discriminate | |].
  - intros r' a A. cbn. unfold update. now destruct (N.eqb_spec r' r) as [->|].
  - intros m J. cbn in J. rewrite app_nil_r in J. now left.
Qed.

Lemma store_ok l s r value : valid l -> swarm_ok l s -> swarm_ok l (operate l s (Store r value)).
Proof.
  intros Valid Ok. apply swarm_step_keeping; auto; [discriminate | |].
  - intros r' a A. cbn [step]. destruct (value <=? _); auto. cbn.
    unfold update. now destruct (N.eqb_spec r' r) as [->|].
  - intros m J. cbn [step] in J. destruct (value <=? _); [|now left]. cbn in J.
    rewrite app_nil_r in J. now left.
Qed.

Lemma fail_ok l s r anew : valid l -> swarm_ok l s -> swarm_ok l (operate l s (Fail r anew)).
Proof.
  intros Valid Ok.
  destruct (swarm_step l s (Crash r anew) Valid Ok) as (R & Held & Net); [discriminate|].
  destruct (reachable_invariant l _ Valid (proj1 Ok)) as (I & _).
  split; [exact R|]. cbn [operate world_of held]. split.
  - intros r' g G.
    assert (K : In g (held s r') /\ forall a, In a g ->
              In a (known (robots (fst (do l (world_of s) (Crash r anew))) r'))).
    { destruct Ok as (_ & Held' & _). cbn [step].
      rewrite resumes by apply (robots_ok l _ I). cbn [fst robots]. unfold update.
      destruct (N.eqb_spec r' r) as [->|].
      - apply filter_In in G as (G & S). rewrite forallb_forall in S. split; auto.
        intros a A. apply filter_In. split; [now apply (Held' r g G) | now apply S].
      - split; auto. now apply Held'. }
    split; [apply (Held r')|]; apply K.
  - cbn [step] in *. rewrite resumes in * by apply (robots_ok l _ I). exact Net.
Qed.

Lemma evolve_ok l operations : valid l -> swarm_ok l (evolve l operations).
Proof.
  intros Valid. induction operations as [|o operations IH] using rev_ind.
  - split; [apply reachable_init|]. cbn. split; [|tauto].
    intros r g [<-|[]]. split; auto. split; [apply genesis_sorted | tauto].
  - unfold evolve. rewrite fold_left_app. cbn [fold_left]. fold (evolve l operations).
    destruct o; auto using add_genes_ok, recombine_ok, broadcast_ok, deliver_ok, listen_ok, wait_ok,
      store_ok, fail_ok.
Qed.

(** ** The claims *)

Lemma in_swarm_chained l operations g : valid l -> in_swarm (evolve l operations) g ->
  chained l (world_of (evolve l operations)) g /\ real l (world_of (evolve l operations)) g.
Proof.
  intros Valid In_. destruct (evolve_ok l operations Valid) as (R & Held & Net).
  destruct (reachable_invariant l _ Valid R) as (_ & P).
  destruct In_ as [(r & G)|(m & M & <-)].
  - split; [now apply (Held r)|]. intros a A. apply (provenance_exists l); auto.
    left. exists r. now apply (Held r g).
  - split; auto. intros a A. apply (provenance_exists l); auto. right. exists m. auto.
Qed.

Section Claims.
Context (l : limits) (operations : list operation) (Valid : valid l).
Notation w := (world_of (evolve l operations)).

Lemma evolved : invariant l w.
Proof. apply (reachable_invariant l), evolve_ok; exact Valid. Qed.

Lemma chain_before g a b : in_swarm (evolve l operations) g -> In a g -> In b g -> a << b ->
  ~ is_genesis l a -> ~ is_genesis l b ->
  exists ea eb, makes w ea a /\ makes w eb b /\ happened_before (history w) ea eb.
Proof.
  intros G A B L Ga Gb. destruct (in_swarm_chained l operations g Valid G) as ((_ & C) & _).
  destruct (C a b A B L Ga Gb) as (ea & eb & Ma & Mb & K). exists ea, eb.
  repeat split; try apply Ma; try apply Mb. eapply known_at_before; eauto using evolved.
Qed.

Lemma genesis_first a e b : is_genesis l a -> makes w e b -> counter a < counter b.
Proof.
  intros G M. apply in_genesis in G. apply (minting l) in M as (-> & _ & L & _); [|exact evolved].
  unfold start in L. cbn. lia.
Qed.

Lemma order_iff_creation g a b : in_swarm (evolve l operations) g -> In a g -> In b g ->
  a << b <-> created_before l w a b.
Proof.
  intros G A B. destruct (in_swarm_chained l operations g Valid G) as (_ & Real). split.
  - intros L. destruct (Real a A) as [Ga|(ea & Ma)], (Real b B) as [Gb|(eb & Mb)].
    + left. repeat split; auto. apply in_genesis in Ga, Gb. apply mark_lt_iff in L. lia.
    + right. left. eauto.
    + destruct (mark_lt_asymmetric _ _ L). apply counter_decides. now apply (genesis_first b ea a).
    + right. right. apply (chain_before g); auto.
      * intros Ga. assert (X := genesis_first a ea a Ga Ma). lia.
      * intros Gb. assert (X := genesis_first b eb b Gb Mb). lia.
  - intros [(_ & _ & L)|[(Ga & e & M)|(ea & eb & Ma & Mb & H)]]; apply counter_decides; auto.
    + now apply (genesis_first a e).
    + exact (clocks_tell l w ea eb a b evolved Ma Mb H).
Qed.
End Claims.

Theorem genome_is_chain : Claims.genome_is_chain.
Proof.
  intros l operations g a b Valid s G A B Ne Ga Gb.
  destruct (mark_lt_total a b) as [L|[|L]]; [|contradiction|].
  - destruct (chain_before l operations Valid g a b) as (ea & eb & ? & ? & ?); auto.
    exists ea, eb. auto.
  - destruct (chain_before l operations Valid g b a) as (eb & ea & ? & ? & ?); auto.
    exists ea, eb. auto.
Qed.

Theorem order_is_creation_order : Claims.order_is_creation_order.
Proof.
  intros l operations g Valid s G.
  split; [apply (in_swarm_chained l operations g Valid G)|].
  intros a b A B. now apply (order_iff_creation l operations Valid g).
Qed.

Theorem order_is_real_time_order : Claims.order_is_real_time_order.
Proof.
  intros l operations g a b ea eb Valid s G A B Ma Mb.
  assert (I := evolved l operations Valid). fold s in I.
  assert (Forth : forall a b ea eb, In a g -> In b g -> makes (world_of s) ea a ->
            makes (world_of s) eb b -> a << b -> (time ea < time eb)%nat).
  { clear a b ea eb A B Ma Mb. intros a b ea eb A B Ma Mb L.
    destruct (chain_before l operations Valid g a b G A B L) as (ea' & eb' & Ma' & Mb' & H).
    - intros Ga. assert (X := genesis_first l operations Valid a ea a Ga Ma). lia.
    - intros Gb. assert (X := genesis_first l operations Valid b eb b Gb Mb). lia.
    - rewrite (made_once l _ ea ea' a I Ma Ma'), (made_once l _ eb eb' b I Mb Mb').
      now apply (before_mono l) in H as (_ & _ & T & _). }
  split; [now apply Forth|]. intros T. destruct (mark_lt_total a b) as [|[<-|L]]; auto.
  - rewrite (made_once l _ ea eb a I Ma Mb) in T. lia.
  - assert (X := Forth b a eb ea B A Mb Ma L). lia.
Qed.

(** ** Any two markings that respect the order of creation *)

Lemma sorted_map (f : mark -> mark) g : sorted g ->
  (forall a b, In a g -> In b g -> a << b -> f a << f b) -> sorted (map f g).
Proof.
  induction g as [|a g IH]; intros S Mono; [constructor|]. apply sorted_cons_iff in S as [S F].
  cbn [map]. apply sorted_cons_iff. split.
  - apply IH; auto. intros x y X Y. apply Mono; now right.
  - intros m J. apply in_map_iff in J as (b & <- & B). apply Mono; auto; [now left | now right].
Qed.

Lemma respecting_sorted l operations (f : mark -> mark) g : valid l ->
  in_swarm (evolve l operations) g -> respects_creation l (world_of (evolve l operations)) f ->
  sorted (map f g).
Proof.
  intros Valid G Respects. destruct (order_is_creation_order l operations g Valid G) as (S & Iff).
  apply sorted_map; auto. intros a b A B L. apply Respects. now apply Iff.
Qed.

(** The two markings agree in all that [Crossover] asks for. *)
Lemma compared_agree l operations gene (mark_of : gene -> mark) a b one two :
  Claims.compared l operations mark_of a b one two ->
  let one := Claims.under one mark_of in let two := Claims.under two mark_of in
  sorted (map one a) /\ sorted (map one b) /\ sorted (map two a) /\ sorted (map two b)
  /\ forall x y, In x a -> In y b -> one x = one y <-> two x = two y.
Proof.
  intros (Valid & A & B & R1 & U1 & R2 & U2). cbn zeta. unfold Claims.under.
  repeat split; try (rewrite <- (map_map mark_of); now apply (respecting_sorted l operations)).
  all: apply (in_map mark_of) in H; apply (in_map mark_of) in H0;
    assert (Ex := proj2 (in_swarm_chained l operations _ Valid A) _ H);
    assert (Ey := proj2 (in_swarm_chained l operations _ Valid B) _ H0);
    intros E; f_equal; auto.
Qed.

Theorem crossover_marking_invariant : Claims.crossover_marking_invariant.
Proof.
  intros l operations gene draws mark_of choose keep d a b one two C.
  apply compared_agree in C as (? & ? & ? & ? & ?). now apply same_crossover.
Qed.

Theorem markings_differ_in_excess_only : Claims.markings_differ_in_excess_only.
Proof.
  intros l operations gene mark_of a b one two C.
  apply compared_agree in C as (? & ? & ? & ? & ?). cbn zeta. split; [|split].
  - now apply same_matches.
  - intros s x. now apply same_unmatched.
  - now apply same_unmatched_count.
Qed.

Theorem distance_marking_invariant : Claims.distance_marking_invariant.
Proof.
  intros l operations gene mark_of a b one two c1 c2 c3 size difference C E.
  apply compared_agree in C as (? & ? & ? & ? & ?). now apply same_distance.
Qed.

Theorem gene_clock_respects_creation : Claims.gene_clock_respects_creation.
Proof.
  intros l operations Valid w. split; [|intros a b _ _ E; exact E].
  intros a b [(_ & _ & L)|[(G & e & M)|(ea & eb & Ma & Mb & H)]]; apply counter_decides; auto.
  - now apply (genesis_first l operations Valid a e).
  - apply (clocks_tell l w ea eb); auto. now apply evolved.
Qed.

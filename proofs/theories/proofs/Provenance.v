(** Where genes come from, when nobody forges messages. *)
From Coq Require Import NArith PeanoNat List Bool Lia.
From GeneClocks Require Import Mark Clock Admission Protocol Genome.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order Arithmetic Invariant Safety.
Import ListNotations.
Open Scope N_scope.

(** The gene's making survives any crash of its maker. *)
Definition published (l : limits) (w : world) (gene : mark) : Prop :=
  is_genesis l gene
  \/ exists e, makes w e gene /\ after e <= stored (robots w (place e)).

(** Robot [r] made the gene, or an event gave it to it. *)
Definition sourced (l : limits) (w : world) (r : N) (gene : mark) : Prop :=
  is_genesis l gene
  \/ exists e, makes w e gene /\
     (place e = r \/
      after e <= stored (robots w (place e)) /\
      exists e', In e' (history w) /\ place e' = r /\ brings e' gene /\ (time e < time e')%nat).

Definition provenance (l : limits) (w : world) : Prop :=
  (forall r gene, In gene (known (robots w r)) -> sourced l w r gene)
  /\ (forall m gene, In m (network w) -> In gene (genes m) -> published l w gene).

(** What [w] records, [w'] records too. *)
Definition extends (w w' : world) : Prop :=
  (forall e, In e (history w) -> In e (history w'))
  /\ forall r, stored (robots w r) <= stored (robots w' r).

Lemma published_extends l w w' gene : extends w w' -> published l w gene -> published l w' gene.
Proof.
  intros (H & S) [G|(e & (J & W) & L)]; [now left | right]. exists e. split; [split; auto|].
  specialize (S (place e)). lia.
Qed.

Lemma sourced_extends l w w' r gene : extends w w' -> sourced l w r gene -> sourced l w' r gene.
Proof.
  intros (H & S) [G|(e & (J & W) & O)]; [now left | right]. exists e. split; [split; auto|].
  destruct O as [O|(L & e' & J' & O)]; [now left | right].
  split; [specialize (S (place e)); lia | exists e'; auto].
Qed.

Lemma commit_extends w r new sent es : stored (robots w r) <= stored new ->
  extends w (commit w r new sent es).
Proof.
  intros L. split; cbn [history robots commit]; intros.
  - apply in_or_app. auto.
  - unfold update. destruct (N.eqb_spec r0 r) as [->|]; lia.
Qed.

(** A sender's gate publishes all that it knows. *)
Lemma gate_publishes l w r gene : invariant l w -> sourced l w r gene ->
  durable (memory (robots w r)) <= stored (robots w r) -> published l w gene.
Proof.
  intros I [G|(e & M & O)] L; [now left | right]. exists e. split; auto.
  destruct O as [<-|[O _]]; auto. destruct M as [J _].
  destruct (events_past l w I e J), (robots_ok l w I (place e)) as (? & _). lia.
Qed.

Lemma crash_provenance l w r anew : invariant l w -> provenance l w ->
  provenance l (fst (do l w (Crash r anew))).
Proof.
  intros I (Known & Net). assert (I' := step_invariant l w (Crash r anew) I).
  cbn [step] in *. rewrite resumes in * by apply (robots_ok l w I). set (w' := fst _) in *.
  assert (Survive : forall e gene, makes w e gene ->
            (place e = r -> after e <= stored (robots w r)) -> makes w' e gene).
  { intros e gene (J & W) L. split; auto. apply in_or_app. left. apply filter_In. split; auto.
    unfold undone. destruct (N.eqb_spec (place e) r) as [E|]; auto. cbn.
    destruct (N.ltb_spec (stored (robots w r)) (after e)); auto. specialize (L E). lia. }
  assert (Stored : forall r', stored (robots w' r') = stored (robots w r')).
  { intros r'. subst w'. cbn. unfold update. destruct (N.eqb_spec r' r) as [->|]; auto. }
  split.
  - intros r' gene K. subst w'. cbn [fst robots] in K. unfold update in K.
    set (w' := fst _) in *. destruct (N.eqb_spec r' r) as [->|Ne].
    + cbn [known] in K. assert (K' := K). apply filter_In in K' as [K' R].
      cbn [retains gene_clocks] in R. apply N.ltb_lt in R.
      destruct (Known r gene K') as [G|(e & M & O)]; [now left | right]. exists e.
      destruct (minting l w e gene I M) as (E & A & _).
      destruct (N.eq_dec (place e) r) as [P|P].
      * split; [|now left]. apply Survive; auto. rewrite E in R. cbn in R. lia.
      * split; [apply Survive; tauto | right]. destruct O as [|[L _]]; [tauto|].
        split; [now rewrite Stored|]. eexists. split; [apply in_or_app; right; now left|].
        cbn. repeat split; auto. destruct M as [J _]. apply (events_past l w I e J).
    + destruct (Known r' gene K) as [G|(e & M & O)]; [now left | right]. exists e.
      split.
      * apply Survive; auto. intros P. destruct O as [|[L _]]; congruence.
      * destruct O as [|(L & e' & J' & P' & O)]; [now left | right].
        split; [now rewrite Stored|]. exists e'. repeat split; try tauto.
        apply in_or_app. left. apply filter_In. split; auto. unfold undone.
        destruct (N.eqb_spec (place e') r); auto. congruence.
  - intros m gene M J. subst w'. cbn [fst network] in M. set (w' := fst _) in *.
    destruct (Net m gene M J) as [G|(e & Me & L)]; [now left | right]. exists e. split.
    + apply Survive; auto. now intros <-.
    + now rewrite Stored.
Qed.

Lemma step_provenance l w c : invariant l w -> provenance l w -> (forall r m, c <> Inject r m) ->
  provenance l (fst (do l w c)).
Proof.
  intros I P Honest. assert (P' := P). destruct P' as (Known & Net).
  assert (Commit : forall r new sent es, let w' := commit w r new sent es in
            stored (robots w r) <= stored new ->
            (forall gene, In gene (known new) ->
               In gene (known (robots w r)) \/ sourced l w' r gene) ->
            (forall m gene, In m sent -> In gene (genes m) -> published l w gene) ->
            provenance l w').
  { intros r new sent es w' S K Sent. assert (X : extends w w') by now apply commit_extends.
    split.
    - intros r' gene. subst w'. cbn [robots commit]. unfold update. set (w' := commit _ _ _ _ _) in *.
      destruct (N.eqb_spec r' r) as [->|]; intros J.
      + destruct (K gene J) as [J'|]; auto. apply (sourced_extends l w); auto.
      + apply (sourced_extends l w); auto.
    - intros m gene. subst w'. cbn [network commit]. intros M J.
      apply in_app_or in M as [M|M]; apply (published_extends l w); eauto. }
  assert (Hear : forall r m k gs,
            (forall gene, In gene (genes m) -> published l w gene) ->
            (forall gene, In gene (genes m) -> In gene gs) ->
            provenance l (fst (hear gene_clocks l w r m (Received k gs)))).
  { intros r m k gs Pub Sub.
    destruct (hear_cases l w r m (Received k gs)) as [(new & L & ->)|(why & ->)]; [|exact P].
    apply (learn_some l) in L as (_ & S & E & _); [|apply (robots_ok l w I)].
    apply Commit; [lia | | intros ? ? []].
    intros gene J. rewrite E in J. apply in_app_or in J as [J|J]; [now left | right].
    destruct (Pub gene J) as [G|(e & (Je & W) & Le)]; [now left | right].
    exists e. split; [split; auto; apply in_or_app; now left|].
    destruct (N.eq_dec (place e) r) as [|Ne]; [now left | right].
    cbn [robots commit]. rewrite update_other by assumption. split; auto.
    eexists. split; [apply in_or_app; right; now left|]. cbn. repeat split; auto.
    apply (events_past l w I e Je). }
  destruct c as [r count|r selection|r k|r k|r m|r|r value|r anew]; [| | | |destruct (Honest r m eq_refl)
    | | | now apply crash_provenance]; cbn [step]; destruct (robots_ok l w I r) as (A & B & C & D).
  - destruct (mint _ _ count) as [[first c]|] eqn:M; [|exact P]. cbn [fst].
    apply mint_some in M as (-> & _); cbn; try lia. apply Commit; cbn [stored known]; [lia | | intros ? ? []].
    intros gene J. apply in_app_or in J as [J|J]; [now left | right; right].
    apply in_minted_marks in J as (Maker & L).
    assert (G : forall n id first, first <= counter gene < first + N.of_nat n ->
              exists e, In e (minted_events id r first n) /\ what e = Minted gene).
    { clear -Maker. induction n as [|n IH]; intros id first L; [lia|]. cbn [minted_events].
      destruct (N.eq_dec (counter gene) first) as [<-|].
      - eexists. split; [now left|]. cbn. rewrite <- Maker. now destruct gene.
      - destruct (IH (S id) (first + 1)) as (e & J & W); [lia|]. exists e. cbn. auto. }
    destruct (G _ (now w) _ L) as (e & J & W). exists e. split; [|left].
    + split; auto. apply in_or_app. now right.
    + now apply minted_event in J as (_ & ? & _).
  - cbn [may_send gene_clocks].
    destruct (N.leb_spec (durable (memory (robots w r))) (stored (robots w r))); [|exact P].
    cbn [fst]. apply Commit; [lia | now left |]. intros m gene [<-|[]] J. cbn [genes] in J.
    apply selected in J as [_ J]. apply (gate_publishes l w r); auto.
  - destruct (nth_error _ k) as [m|] eqn:K; [|exact P]. apply nth_error_In in K.
    apply Hear; auto. intros gene. now apply Net.
  - destruct (nth_error _ k) as [m|] eqn:K; [|exact P]. apply Hear; cbn; tauto.
  - apply Commit; cbn; [lia | now left | intros ? ? []].
  - destruct (value <=? _); [|exact P]. cbn [fst]. apply Commit; cbn; [lia | now left | intros ? ? []].
Qed.

Lemma run_provenance l commands : valid l -> Claims.honest commands ->
  provenance l (after_all l commands).
Proof.
  intros Valid. apply (run_induction l Valid (fun commands w =>
    Claims.honest commands -> provenance l w)).
  - intros _. split; cbn; [intros r gene J; now left | intros ? ? []].
  - intros cs c I P Honest. apply step_provenance; auto.
    + apply P. intros r m J. apply (Honest r m), in_or_app. now left.
    + intros r m ->. apply (Honest r m), in_or_app. right. now left.
Qed.

Lemma provenance_exists l w gene : provenance l w ->
  (exists r, In gene (known (robots w r))) \/ (exists m, In m (network w) /\ In gene (genes m)) ->
  exists_in l w gene.
Proof.
  intros (Known & Net) [(r & J)|(m & M & J)].
  - destruct (Known r gene J) as [|(e & ? & _)]; [now left | right; eauto].
  - destruct (Net m gene M J) as [|(e & ? & _)]; [now left | right; eauto].
Qed.

Theorem genes_have_makers : Claims.genes_have_makers.
Proof.
  intros l commands gene Valid Honest w. now apply provenance_exists, run_provenance.
Qed.

Theorem own_mark_in_past : Claims.own_mark_in_past.
Proof.
  intros l commands gene Valid Honest w Somewhere New.
  assert (I := run_invariant l Valid commands). fold w in I.
  destruct (genes_have_makers l commands gene Valid Honest Somewhere) as [|(e & M)]; [tauto|].
  destruct (minting l w e gene I M) as (E & A & _). destruct M as [J _].
  destruct (events_past l w I e J) as (_ & _ & L). rewrite E. cbn. lia.
Qed.

Theorem stamp_alone_decides : Claims.stamp_alone_decides.
Proof.
  intros l commands r k Valid Honest w. assert (I := run_invariant l Valid commands). fold w in I.
  cbn [step]. destruct (nth_error (network w) k) as [m|] eqn:K; [|reflexivity].
  assert (Covered : credible gene_clocks m = true).
  { destruct (messages_were_sent l w I k m K) as (e & J & S).
    assert (E := events_ok l w I e J). unfold event_ok in E. rewrite S in E.
    destruct E as (_ & m' & K' & _ & Low). replace m' with m in * by congruence.
    apply forallb_forall. intros gene G. apply N.ltb_lt, Low, G. }
  assert (Mine : existsb (unmade (next (memory (robots w r))) r) (genes m) = false).
  { destruct (existsb _ (genes m)) eqn:E; auto. apply existsb_exists in E as (gene & J & U).
    unfold unmade in U. apply andb_prop in U as (M & L). apply N.eqb_eq in M. apply N.leb_le in L.
    destruct (robots_ok l w I r) as (A & _).
    assert (~ is_genesis l gene).
    { intros G. apply in_genesis in G. unfold start in A. lia. }
    assert (counter gene < next (memory (robots w (maker gene)))); [|rewrite M in *; lia].
    apply own_mark_in_past; auto. right. exists m. split; auto. now apply nth_error_In in K. }
  unfold hear, learn. rewrite Covered. cbn [credible gene_clocks genes stamp forallb gated].
  unfold pass. rewrite Mine. cbn [existsb].
  destruct (guard (robots w r)) as [g|].
  - destruct (accept _ _ g (stamp m)) as [[c g']|]; reflexivity.
  - destruct (merge _ _ _ (stamp m)); reflexivity.
Qed.

(** The checker accepts what a run of the protocol records. *)
From Coq Require Import NArith PeanoNat List Bool FMapPositive Lia.
From GeneClocks Require Import Mark Clock Protocol Recording.
From GeneClocks Require Claims Trace.
From GeneClocks.proofs Require Import Arithmetic Invariant.
From GeneClocks.proofs Require TraceSafety.
Import ListNotations.
Open Scope N_scope.

Section NoFalseAlarms.
Context (l : limits) (Valid : valid l).

(** The checker sees the world as it is. *)
Definition agrees (w : world) (c : Trace.checker) : Prop :=
  (forall r, Trace.seat_of l c r = Trace.Seat (next (memory (robots w r))) (stored (robots w r)))
  /\ Trace.sent c = N.of_nat (length (network w))
  /\ forall k, PositiveMap.find (Trace.key (N.of_nat k)) (Trace.stamps c)
               = option_map stamp (nth_error (network w) k).

Lemma agrees_update w c r new sent es : agrees w c -> sent = [] ->
  agrees (commit w r new sent es)
         (Trace.sit c r (Trace.Seat (next (memory new)) (stored new))).
Proof.
  intros (Seats & Sent & Stamps) ->. split; [|cbn; rewrite app_nil_r; auto].
  intros r'. rewrite TraceSafety.seat_of_sit, Seats. cbn. unfold update.
  now destruct (r' =? r).
Qed.

Lemma newest_below n gs : 0 < n -> below n gs -> newest gs < n.
Proof.
  intros P B. unfold newest. induction gs as [|g gs IH]; cbn; auto.
  assert (counter g < n) by (apply B; now left).
  assert (fold_right N.max 0 (map counter gs) < n) by (apply IH; intros x J; apply B; now right).
  lia.
Qed.

Lemma observe_next c stamp c' : observe l c stamp = Some c' ->
  exists c'', observe l (restart (next c)) stamp = Some c'' /\ next c'' = next c'.
Proof.
  intros H. destruct (observe l (restart (next c)) stamp) as [c''|] eqn:E.
  - exists c''. split; auto. now rewrite (observe_is_maximum _ _ _ _ E), (observe_is_maximum _ _ _ _ H).
  - apply observe_none in E. cbn in E. apply observe_none in E. congruence.
Qed.

Lemma entry_accepted w c command entry : invariant l w -> agrees w c ->
  entries_of l w command = [entry] -> exists c',
    Trace.check_entry l c entry = inl c' /\ agrees (fst (do l w command)) c'.
Proof.
  intros I Agrees. assert (A := Agrees). destruct A as (Seats & Sent & Stamps).
  unfold entries_of. destruct command as [r count|r selection|r k|r m|r value|r]; cbn [step];
    destruct (robots_ok l w I r) as (A & B & C & D).
  - destruct (mint l _ count) as [[first clock]|] eqn:M; [|discriminate]. intros [= <-].
    cbn [Trace.check_entry Trace.robot_of fst]. rewrite Seats. cbn [Trace.next_of Trace.stored_of].
    apply mint_some in M as (-> & N & D' & _); try lia. rewrite N.eqb_refl. cbn [Trace.require].
    destruct (mint l _ count) as [[first clock']|] eqn:M'.
    + apply mint_some in M' as (_ & N' & _); cbn in *; try lia. eexists. split; [reflexivity|].
      replace (next clock') with (next clock) by lia. exact (agrees_update w c r (Robot _ _ _) [] _ Agrees eq_refl).
    + apply mint_none in M'; cbn in *; lia.
  - cbn [may_send gene_clocks]. destruct (N.leb_spec (durable (memory (robots w r)))
      (stored (robots w r))); [|discriminate]. intros [= <-].
    cbn [Trace.check_entry Trace.robot_of fst]. rewrite Seats. cbn [Trace.next_of Trace.stored_of].
    rewrite N.eqb_refl. cbn [Trace.require].
    replace (next (memory (robots w r)) <=? stored (robots w r)) with true
      by (symmetry; apply N.leb_le; lia).
    cbn [Trace.require]. set (gs := filter _ selection).
    replace (newest gs <? next (memory (robots w r))) with true.
    2:{ symmetry. apply N.ltb_lt, newest_below; [unfold start in A; lia|].
        intros gene J. apply selected in J as [_ J]. now apply D. }
    cbn [Trace.require]. eexists. split; [reflexivity|]. split; [|split].
    + intros r'. cbn. unfold Trace.seat_of in *. cbn. rewrite Seats. unfold update.
      now destruct (N.eqb_spec r' r) as [->|].
    + cbn. rewrite app_length, Sent. cbn. lia.
    + intros k. cbn. rewrite Sent. destruct (Nat.eq_dec k (length (network w))) as [->|Ne].
      * rewrite PositiveMap.gss, nth_error_app2, Nat.sub_diag by auto. reflexivity.
      * rewrite PositiveMap.gso by (intros E; apply TraceSafety.key_injective in E; lia).
        rewrite Stamps. destruct (Nat.lt_ge_cases k (length (network w))).
        -- now rewrite nth_error_app1.
        -- rewrite nth_error_app2 by assumption.
           rewrite (proj2 (nth_error_None (network w) k)) by assumption.
           now rewrite (proj2 (nth_error_None [_] _)) by (cbn; lia).
  - destruct (nth_error (network w) k) as [m|] eqn:K; [|discriminate].
    unfold learn. cbn [credible merge gene_clocks].
    destruct (forallb _ (genes m)); [|discriminate].
    destruct (observe l (memory (robots w r)) (stamp m)) as [clock|] eqn:O; [|discriminate].
    intros [= <-]. cbn [Trace.check_entry Trace.robot_of fst]. rewrite Seats, Stamps, K.
    unfold Trace.memory_of. cbn [option_map Trace.next_of].
    destruct (observe_next _ _ _ O) as (clock' & -> & N).
    cbn [robots commit]. rewrite update_same. cbn [memory]. rewrite N, N.eqb_refl.
    cbn [Trace.require]. eexists. split; [reflexivity|]. exact (agrees_update w c r (Robot _ _ _) [] _ Agrees eq_refl).
  - destruct (learn _ _ _ m); discriminate.
  - destruct (N.leb_spec value (durable (memory (robots w r)))); [|discriminate]. intros [= <-].
    cbn [Trace.check_entry Trace.robot_of fst]. rewrite Seats. cbn [Trace.next_of Trace.stored_of].
    cbn [robots commit]. rewrite update_same. cbn [stored].
    replace ((_ <=? _) && (_ <=? _)) with true.
    2:{ symmetry. apply andb_true_intro. split; apply N.leb_le; lia. }
    cbn [Trace.require]. eexists. split; [reflexivity|]. exact (agrees_update w c r (Robot _ _ _) [] _ Agrees eq_refl).
  - intros [= <-]. cbn [Trace.check_entry Trace.robot_of fst robots]. rewrite Seats, update_same.
    cbn [Trace.stored_of memory resume gene_clocks restart next]. rewrite N.eqb_refl.
    cbn [Trace.require]. eexists. split; [reflexivity|]. split; [|cbn; auto].
    intros r'. rewrite TraceSafety.seat_of_sit, Seats. cbn. unfold update. now destruct (r' =? r).
Qed.

Lemma silent w command c : (forall r m, command <> Inject r m) -> agrees w c ->
  entries_of l w command = [] -> agrees (fst (do l w command)) c.
Proof.
  intros Honest A. unfold entries_of.
  destruct command as [r count|r selection|r k|r m|r value|r]; cbn [step].
  - destruct (mint _ _ _) as [[? ?]|]; [discriminate | auto].
  - destruct (may_send _ _); [discriminate | auto].
  - destruct (nth_error _ k) as [m|]; [destruct (learn _ _ _ m); [discriminate|]|]; auto.
  - destruct (Honest r m eq_refl).
  - destruct (value <=? _); [discriminate | auto].
  - discriminate.
Qed.

Lemma at_most_one w command : entries_of l w command = [] \/
  exists entry, entries_of l w command = [entry].
Proof.
  unfold entries_of. destruct command; try (destruct (do l w _) as (w', []));
    solve [now left | right; eexists; reflexivity].
Qed.

Lemma recording_from_accepted commands w c position : invariant l w -> agrees w c ->
  Claims.honest commands -> exists c',
    Trace.check_from l c position (recording_from l w commands) = inl c'.
Proof.
  revert w c position. induction commands as [|command commands IH]; intros w c position I A Honest.
  - exists c. reflexivity.
  - assert (Honest' : Claims.honest commands) by (intros r m J; apply (Honest r m); now right).
    assert (I' := step_invariant l w command I). cbn [recording_from].
    destruct (at_most_one w command) as [E|(entry & E)]; rewrite E; cbn [app Trace.check_from].
    + apply IH; auto. apply silent; auto. intros r m ->. apply (Honest r m). now left.
    + destruct (entry_accepted w c command entry I A E) as (c' & -> & A'). now apply IH.
Qed.
End NoFalseAlarms.

Theorem recordings_accepted : Claims.recordings_accepted.
Proof.
  intros l commands Valid Honest. apply recording_from_accepted; auto.
  - now apply init_invariant.
  - split; [|split].
    + intros r. unfold Trace.seat_of, Trace.check_init. cbn. now rewrite PositiveMap.gempty.
    + reflexivity.
    + intros k. cbn. rewrite PositiveMap.gempty. now destruct k.
Qed.

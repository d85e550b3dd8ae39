(** The checker accepts what a run of the protocol records. *)
From Coq Require Import NArith PeanoNat List Bool FMapPositive Lia.
From GeneClocks Require Import Mark Clock Admission Protocol Recording.
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

Lemma learn_next r s m new : robot_ok l s -> learn gene_clocks l r s m = inl new ->
  exists c, observe l (Clock (next (memory s)) (next (memory s))) (stamp m) = Some c
    /\ next c = next (memory new).
Proof.
  intros Ok H. apply (learn_some l) in H as (Ok' & _ & _ & _ & E & _ & W & _); auto.
  assert (stamp m <= maximum l) by (destruct Ok' as (A & B & _); lia).
  unfold Claims.reach in W. assert (stamp m <= next (memory s) + window l)
    by (destruct (guard s); lia).
  destruct (observe l _ (stamp m)) as [c|] eqn:O.
  - exists c. split; auto. apply observe_is_maximum in O. cbn in O. lia.
  - apply observe_none in O. cbn in O. lia.
Qed.

(** An accepted message is right by the checker too. *)
Lemma heard_accepted w c r k m how w' : invariant l w -> agrees w c ->
  nth_error (network w) k = Some m -> forall heard, stamp heard = stamp m ->
  hear gene_clocks l w r heard how = (w', Accepted) -> exists c',
    Trace.check_entry l c (Trace.Receives r (N.of_nat k) (next (memory (robots w' r)))) = inl c'
    /\ agrees w' c'.
Proof.
  intros I Agrees K heard Same H. assert (A := Agrees). destruct A as (Seats & Sent & Stamps).
  destruct (hear_cases l w r heard how) as [(new & L & E)|(why & E)]; rewrite E in H;
    [|discriminate]. injection H as <-.
  assert (S := proj1 (proj2 (learn_some l r _ _ _ (robots_ok l w I r) L))).
  destruct (learn_next _ _ _ _ (robots_ok l w I r) L) as (clock & O & N). rewrite Same in O.
  cbn [Trace.check_entry Trace.robot_of]. rewrite Seats, Stamps, K.
  unfold Trace.memory_of. cbn [option_map Trace.next_of]. rewrite O.
  cbn [robots commit]. rewrite update_same, N, N.eqb_refl. cbn [Trace.require].
  eexists. split; [reflexivity|]. cbn [Trace.stored_of]. rewrite <- S.
  exact (agrees_update w c r new [] _ Agrees eq_refl).
Qed.

Lemma entry_accepted w c command entry : invariant l w -> agrees w c ->
  entries_of l w command = [entry] -> exists c',
    Trace.check_entry l c entry = inl c' /\ agrees (fst (do l w command)) c'.
Proof.
  intros I Agrees. assert (A := Agrees). destruct A as (Seats & Sent & Stamps).
  unfold entries_of. destruct command as [r count|r selection|r k|r k|r m|r|r value|r anew];
    cbn [step]; destruct (robots_ok l w I r) as (A & B & C & D).
  - destruct (mint (own_limits l _) _ count) as [[first clock]|] eqn:M; [|discriminate]. intros [= <-].
    cbn [Trace.check_entry Trace.robot_of fst]. rewrite Seats. cbn [Trace.next_of Trace.stored_of].
    apply mint_some in M as (-> & N & D' & _); cbn; try lia. rewrite N.eqb_refl. cbn [Trace.require].
    destruct (mint l _ count) as [[first clock']|] eqn:M'.
    + apply mint_some in M' as (_ & N' & _); cbn in *; try lia. eexists. split; [reflexivity|].
      replace (next clock') with (next clock) by lia. exact (agrees_update w c r (Robot _ _ _ _ _) [] _ Agrees eq_refl).
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
    destruct (hear _ l w r m _) as (w', []) eqn:H; try discriminate. intros [= <-].
    now apply (heard_accepted w c r k m _ w' I Agrees K m eq_refl H).
  - destruct (nth_error (network w) k) as [m|] eqn:K; [|discriminate].
    destruct (hear _ l w r _ _) as (w', []) eqn:H; try discriminate. intros [= <-].
    now apply (heard_accepted w c r k m _ w' I Agrees K (Message (stamp m) []) eq_refl H).
  - destruct (hear _ l w r m _) as (w', []); discriminate.
  - discriminate.
  - destruct (N.leb_spec value (maximum l)); [|discriminate]. intros [= <-].
    cbn [Trace.check_entry Trace.robot_of fst]. rewrite Seats. cbn [Trace.next_of Trace.stored_of].
    cbn [robots commit]. rewrite update_same. cbn [stored].
    replace ((_ <=? _) && (_ <=? _)) with true.
    2:{ symmetry. apply andb_true_intro. split; apply N.leb_le; lia. }
    cbn [Trace.require]. eexists. split; [reflexivity|].
    exact (agrees_update w c r (Robot _ _ _ _ _) [] _ Agrees eq_refl).
  - rewrite resumes by apply (robots_ok l w I). intros [= <-].
    cbn [Trace.check_entry Trace.robot_of fst robots]. rewrite Seats, update_same.
    cbn [Trace.stored_of memory next]. rewrite N.eqb_refl.
    cbn [Trace.require]. eexists. split; [reflexivity|]. split; [|cbn; auto].
    intros r'. rewrite TraceSafety.seat_of_sit, Seats. cbn. unfold update. now destruct (r' =? r).
Qed.

Lemma silent w command c : invariant l w -> (forall r m, command <> Inject r m) -> agrees w c ->
  entries_of l w command = [] -> agrees (fst (do l w command)) c.
Proof.
  intros I Honest A. unfold entries_of.
  destruct command as [r count|r selection|r k|r k|r m|r|r value|r anew]; cbn [step].
  - destruct (mint _ _ _) as [[? ?]|]; [discriminate | auto].
  - destruct (may_send _ _); [discriminate | auto].
  - destruct (nth_error _ k) as [m|]; auto. unfold hear.
    destruct (learn _ _ _ _ m); [discriminate | auto].
  - destruct (nth_error _ k) as [m|]; auto. unfold hear.
    destruct (learn _ _ _ _ _); [discriminate | auto].
  - destruct (Honest r m eq_refl).
  - intros _. destruct A as (Seats & A). split; [|cbn; now rewrite app_nil_r].
    intros r'. rewrite Seats. cbn. unfold update. now destruct (N.eqb_spec r' r) as [->|].
  - destruct (value <=? _); [discriminate | auto].
  - rewrite resumes by apply (robots_ok l w I). discriminate.
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

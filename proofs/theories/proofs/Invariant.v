(** What holds of every world that the protocol can reach. *)
From Coq Require Import NArith PeanoNat List Bool Lia.
From GeneClocks Require Import Mark Clock Admission Protocol.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order Arithmetic.
Import ListNotations.
Open Scope N_scope.

Notation do := (step gene_clocks).
Notation after_all := (run gene_clocks).

Section Invariant.
Context (l : limits) (Valid : valid l).

Definition below (n : N) (gs : list mark) : Prop := forall gene, In gene gs -> counter gene < n.

Definition robot_ok (s : robot) : Prop :=
  start l <= next (memory s) <= durable (memory s) /\ durable (memory s) <= maximum l
  /\ start l <= stored s <= maximum l /\ below (next (memory s)) (known s).

Definition event_ok (w : world) (e : event) : Prop :=
  match what e with
  | Minted gene => gene = Mark (before e) (place e) /\ after e = before e + 1
      /\ start l <= before e /\ after e <= maximum l
  | Sent k => after e <= stored (robots w (place e))
      /\ exists m, nth_error (network w) k = Some m /\ stamp m = after e
           /\ below (stamp m) (genes m)
  | Received k gs => below (after e) gs
      /\ exists m, nth_error (network w) k = Some m /\ stamp m <= after e
           /\ forall gene, In gene gs -> In gene (genes m)
  | Injected gs | Restarted gs => below (after e) gs
  end.

Record invariant (w : world) : Prop := {
  robots_ok : forall r, robot_ok (robots w r);
  events_ok : forall e, In e (history w) -> event_ok w e;
  events_past : forall e, In e (history w) -> (time e < now w)%nat
      /\ before e <= after e <= next (memory (robots w (place e)));
  one_event_a_time : forall e1 e2, In e1 (history w) -> In e2 (history w) ->
      time e1 = time e2 -> e1 = e2;
  robot_order : forall e1 e2, In e1 (history w) -> In e2 (history w) -> place e1 = place e2 ->
      (time e1 < time e2)%nat -> after e1 <= before e2;
  sent_before_received : forall e k gs, In e (history w) -> what e = Received k gs ->
      exists e', In e' (history w) /\ what e' = Sent k /\ (time e' < time e)%nat;
  messages_were_sent : forall k m, nth_error (network w) k = Some m ->
      exists e, In e (history w) /\ what e = Sent k;
  sent_once : forall k e1 e2, In e1 (history w) -> In e2 (history w) ->
      what e1 = Sent k -> what e2 = Sent k -> e1 = e2;
  sent_not_lost : forall e k, In e (lost w) -> what e <> Sent k
}.

(** ** Adding events *)

(** Events of one robot, one after the other, that take its clock from [low] to [high]. *)
Fixpoint consecutive (id : nat) (r low : N) (es : list event) (high : N) : Prop :=
  match es with
  | [] => low <= high
  | e :: es' => time e = id /\ place e = r /\ low <= before e <= after e
      /\ consecutive (S id) r (after e) es' high
  end.

Lemma consecutive_bounds id r low es high : consecutive id r low es high -> low <= high
  /\ forall e, In e es -> (id <= time e < id + length es)%nat /\ place e = r
       /\ low <= before e /\ before e <= after e /\ after e <= high.
Proof.
  revert id low. induction es as [|e es IH]; intros id low C; cbn in *; [split; auto; tauto|].
  destruct C as (T & P & (B & A) & C). apply IH in C as (L & C). split; [lia|].
  intros e' [<-|I]; [repeat split; auto; lia|]. destruct (C e' I) as (? & ? & ? & ? & ?).
  repeat split; auto; lia.
Qed.

Lemma consecutive_order id r low es high : consecutive id r low es high -> forall e1 e2,
  In e1 es -> In e2 es ->
  (time e1 = time e2 -> e1 = e2) /\ ((time e1 < time e2)%nat -> after e1 <= before e2).
Proof.
  revert id low. induction es as [|e es IH]; intros id low C; cbn in *; [tauto|].
  destruct C as (T & P & A & C). assert (C' := C). apply consecutive_bounds in C' as (_ & C').
  intros e1 e2 [<-|I1] [<-|I2]; [split; auto; lia | | | eapply IH; eauto].
  - destruct (C' _ I2) as (? & _ & ? & _). split; [lia | auto].
  - destruct (C' _ I1) as (? & _). split; lia.
Qed.

Lemma update_same robots r new : update robots r new r = new.
Proof. unfold update. now rewrite N.eqb_refl. Qed.

Lemma update_other robots r new r' : r' <> r -> update robots r new r' = robots r'.
Proof. intros H. unfold update. now apply N.eqb_neq in H as ->. Qed.

Lemma update_ind (P : robot -> Prop) robots r new :
  P new -> (forall r', P (robots r')) -> forall r', P (update robots r new r').
Proof. intros. unfold update. destruct (r' =? r); auto. Qed.

Lemma nth_error_extend {A} (xs ys : list A) k x :
  nth_error xs k = Some x -> nth_error (xs ++ ys) k = Some x.
Proof. intros H. rewrite nth_error_app1; auto. apply nth_error_Some. congruence. Qed.

(** The new events send nothing, or one message. *)
Definition sends_properly (w : world) (sent : list message) (es : list event) : Prop :=
  (sent = [] /\ forall e k, In e es -> what e <> Sent k)
  \/ exists m e, sent = [m] /\ es = [e] /\ what e = Sent (length (network w)).

Lemma commit_invariant w r new sent es :
  let s := robots w r in let w' := commit w r new sent es in
  invariant w -> robot_ok new -> stored s <= stored new ->
  consecutive (now w) r (next (memory s)) es (next (memory new)) ->
  (forall e, In e es -> event_ok w' e) -> sends_properly w sent es -> invariant w'.
Proof.
  intros s w' I Ok Stored C New Sends. subst s w'.
  destruct (consecutive_bounds _ _ _ _ _ C) as (Grow & Bounds).
  assert (Order := consecutive_order _ _ _ _ _ C).
  assert (Old : forall e, In e (history w) -> place e = r -> after e <= next (memory (robots w r))).
  { intros e J <-. apply (events_past w I e J). }
  (* a message received by a new event had been there before *)
  assert (Known : forall e k gs, In e es -> what e = Received k gs ->
            exists m, nth_error (network w) k = Some m).
  { intros e k gs J W. destruct Sends as [[-> _]|(m & e' & _ & -> & S)].
    - specialize (New e J). unfold event_ok in New. rewrite W in New.
      destruct New as (_ & m & M & _). cbn in M. rewrite app_nil_r in M. eauto.
    - destruct J as [<-|[]]. congruence. }
  split; cbn [robots network history lost now commit].
  - apply update_ind; [exact Ok | apply (robots_ok w I)].
  - intros e J. apply in_app_or in J as [J|J]; [|auto].
    assert (E := events_ok w I e J). unfold event_ok in *. cbn [robots network commit].
    destruct (what e); auto.
    + destruct E as (E & m & M & ?). split; [|exists m; auto using nth_error_extend].
      unfold update. destruct (N.eqb_spec (place e) r) as [Eq|]; [rewrite Eq in E|]; lia.
    + destruct E as (E & m & M & ?). split; [|exists m]; auto using nth_error_extend.
  - intros e J. apply in_app_or in J as [J|J].
    + destruct (events_past w I e J). split; [lia|]. unfold update.
      destruct (N.eqb_spec (place e) r) as [<-|]; lia.
    + destruct (Bounds e J) as (? & -> & ? & ? & ?). rewrite update_same. lia.
  - intros e1 e2 J1 J2 T. apply in_app_or in J1 as [J1|J1], J2 as [J2|J2].
    + now apply (one_event_a_time w I).
    + destruct (events_past w I e1 J1), (Bounds e2 J2). lia.
    + destruct (events_past w I e2 J2), (Bounds e1 J1). lia.
    + now apply Order.
  - intros e1 e2 J1 J2 P T. apply in_app_or in J1 as [J1|J1], J2 as [J2|J2].
    + now apply (robot_order w I).
    + destruct (Bounds e2 J2) as (_ & P' & L & _). assert (O := Old e1 J1). lia.
    + destruct (events_past w I e2 J2), (Bounds e1 J1). lia.
    + now apply Order.
  - intros e k gs J W. apply in_app_or in J as [J|J].
    + destruct (sent_before_received w I e k gs J W) as (e' & ? & ? & ?).
      exists e'. auto using in_or_app.
    + destruct (Known e k gs J W) as (m & M).
      destruct (messages_were_sent w I k m M) as (e' & J' & S).
      exists e'. repeat split; auto using in_or_app.
      destruct (events_past w I e' J'), (Bounds e J). lia.
  - intros k m M. destruct (Nat.lt_ge_cases k (length (network w))) as [Lt|Ge].
    + rewrite nth_error_app1 in M by assumption.
      destruct (messages_were_sent w I k m M) as (e & ? & ?). exists e. auto using in_or_app.
    + rewrite nth_error_app2 in M by assumption.
      destruct Sends as [[-> _]|(m' & e & -> & -> & S)].
      * destruct (k - length (network w))%nat; discriminate.
      * exists e. split; [apply in_or_app; right; now left|]. rewrite S. f_equal.
        destruct (k - length (network w))%nat as [|[]] eqn:D; try discriminate. lia.
  - assert (Once : forall k e, In e (history w) -> what e = Sent k -> (k < length (network w))%nat).
    { intros k e J W. assert (E := events_ok w I e J). unfold event_ok in E. rewrite W in E.
      destruct E as (_ & m & M & _). apply nth_error_Some. congruence. }
    intros k e1 e2 J1 J2 W1 W2.
    destruct Sends as [[_ No]|(m & e & _ & -> & S)].
    + apply in_app_or in J1 as [J1|J1]; [|destruct (No _ _ J1 W1)].
      apply in_app_or in J2 as [J2|J2]; [|destruct (No _ _ J2 W2)].
      now apply (sent_once w I k).
    + apply in_app_or in J1 as [J1|[<-|[]]], J2 as [J2|[<-|[]]]; auto.
      * now apply (sent_once w I k).
      * specialize (Once k e1 J1 W1). assert (k = length (network w)) by congruence. lia.
      * specialize (Once k e2 J2 W2). assert (k = length (network w)) by congruence. lia.
  - apply (sent_not_lost w I).
Qed.

(** ** Each command preserves the invariant *)

Lemma minted_consecutive id r first n high : first + N.of_nat n <= high ->
  consecutive id r first (minted_events id r first n) high.
Proof.
  revert id first. induction n as [|n IH]; intros id first H; cbn [minted_events consecutive].
  - lia.
  - cbn. repeat split; try lia. apply IH. lia.
Qed.

Lemma minted_event id r first n e : In e (minted_events id r first n) ->
  what e = Minted (Mark (before e) r) /\ place e = r /\ after e = before e + 1
  /\ first <= before e < first + N.of_nat n.
Proof.
  revert id first. induction n as [|n IH]; intros id first; cbn [minted_events]; [intros []|].
  intros [<-|J]; [cbn; repeat split; lia|]. apply IH in J as (? & ? & ? & ?).
  repeat split; auto; lia.
Qed.

Lemma in_minted_marks r first n gene : In gene (minted_marks r first n) <->
  maker gene = r /\ first <= counter gene < first + N.of_nat n.
Proof.
  unfold minted_marks. rewrite in_map_iff. split.
  - intros (i & <- & J). apply in_seq in J. cbn. lia.
  - intros (<- & L). exists (N.to_nat (counter gene - first)). rewrite in_seq. split; [|lia].
    rewrite N2Nat.id. destruct gene; cbn in *. f_equal. lia.
Qed.

(** All that the proofs need to know of a gate: it refuses more than the clock by itself does. *)
Lemma pass_some l' r c g at_stamp gs c' g' : pass l' r c g at_stamp gs = inl (c', g') ->
  observe l' c at_stamp = Some c' /\ law g' = law g
  /\ next c' + allowance g' = next c + allowance g.
Proof.
  unfold pass, accept. destruct (existsb _ gs); [discriminate|].
  destruct (observe l' c at_stamp) as [o|] eqn:O; [|discriminate].
  destruct (N.ltb_spec (allowance g) (next o - next c)) as [|H]; [discriminate|].
  intros [= <- <-]. apply observe_is_maximum in O. cbn. repeat split. lia.
Qed.

Lemma window_bounds s c at_stamp :
  observe (own_limits l s) (memory s) at_stamp = Some c -> at_stamp <= next (memory s) + window l.
Proof.
  intros O. destruct (N.le_gt_cases at_stamp (next (memory s) + window l)) as [|H]; auto.
  assert (observe (own_limits l s) (memory s) at_stamp = None); [|congruence].
  apply observe_none. now right.
Qed.

Lemma learn_some r s m new : robot_ok s -> learn gene_clocks l r s m = inl new ->
  robot_ok new /\ stored new = stored s /\ known new = known s ++ genes m
  /\ block_of new = block_of s
  /\ next (memory new) = N.max (next (memory s)) (stamp m)
  /\ below (stamp m) (genes m) /\ stamp m <= next (memory s) + Claims.reach l s
  /\ durable (memory new) <= N.max (durable (memory s)) (next (memory new) + block_of s).
Proof.
  intros (A & B & C & D). unfold learn. cbn [credible merge gated gene_clocks].
  destruct (forallb _ (genes m)) eqn:F; [|discriminate].
  assert (Low : below (stamp m) (genes m)).
  { intros gene J. rewrite forallb_forall in F. now apply N.ltb_lt, F. }
  assert (Learnt : forall c g, observe (own_limits l s) (memory s) (stamp m) = Some c ->
    stamp m <= next (memory s) + Claims.reach l s ->
    let new := Robot c (stored s) (known s ++ genes m) (block_of s) g in
    robot_ok new /\ next c = N.max (next (memory s)) (stamp m)
    /\ durable c <= N.max (durable (memory s)) (next c + block_of s)).
  { intros c g O R. destruct (observe_some (own_limits l s) (memory s) (stamp m) c)
      as (E & ? & ? & ? & ?); try (cbn; lia); auto.
    cbn in *. repeat split; auto; try lia; cbn; try lia.
    intros gene J. apply in_app_or in J as [J|J]; [specialize (D _ J) | specialize (Low _ J)]; lia. }
  destruct (guard s) as [g|] eqn:G.
  - destruct (pass _ r _ g _ _) as [[c g']|] eqn:O; [|discriminate]. intros [= <-].
    apply pass_some in O as (O & _ & Paid).
    assert (O' := O). apply observe_is_maximum in O'.
    assert (R : stamp m <= next (memory s) + Claims.reach l s).
    { unfold Claims.reach. rewrite G. assert (W := window_bounds s c _ O). lia. }
    destruct (Learnt c (Some g') O R) as (K & ? & ?). split; [exact K|]. cbn. repeat split; auto; lia.
  - destruct (observe _ _ (stamp m)) as [c|] eqn:O; [|discriminate]. intros [= <-].
    assert (R : stamp m <= next (memory s) + Claims.reach l s).
    { unfold Claims.reach. rewrite G. exact (window_bounds s c _ O). }
    destruct (Learnt c None eq_refl R) as (K & ? & ?). split; [exact K|]. cbn. repeat split; auto; lia.
Qed.

(** What a robot hears leaves the world alone, or is learnt. *)
Lemma hear_cases w r m how :
  (exists new, learn gene_clocks l r (robots w r) m = inl new
     /\ hear gene_clocks l w r m how = (commit w r new [] [event_now w r how new], Accepted))
  \/ exists why, hear gene_clocks l w r m how = (w, Refused why).
Proof. unfold hear. destruct (learn gene_clocks l r (robots w r) m); eauto. Qed.

Lemma knows_in s gene : knows s gene = true <-> In gene (known s).
Proof.
  unfold knows. rewrite existsb_exists. split.
  - intros (x & J & E). apply mark_eqb_eq in E. now subst.
  - intros J. exists gene. split; auto. now apply mark_eqb_eq.
Qed.

Lemma selected s selection gene :
  In gene (filter (knows s) selection) <-> In gene selection /\ In gene (known s).
Proof. now rewrite filter_In, knows_in. Qed.

(** The clock comes back from whatever was stored. *)
Lemma resumes s : robot_ok s -> resume gene_clocks l (stored s) = Some (Clock (stored s) (stored s)).
Proof.
  intros (_ & _ & C & _). apply restart_admits. unfold start in C. lia.
Qed.

Lemma crash_invariant w r anew : invariant w -> invariant (fst (do l w (Crash r anew))).
Proof.
  intros I. cbn [step]. rewrite resumes by apply (robots_ok w I). cbn [fst next].
  set (s := robots w r).
  destruct (robots_ok w I r) as (A & B & C & D). fold s in A, B, C, D.
  set (left := filter _ (known s)).
  assert (Left : below (stored s) left).
  { intros gene J. apply filter_In in J as [_ J]. now apply N.ltb_lt. }
  set (boot := Event _ _ _ _ _).
  assert (Kept : forall e, In e (filter (fun e => negb (undone w r e)) (history w)) <->
            In e (history w) /\ (place e = r -> after e <= stored s)).
  { intros e. rewrite filter_In. unfold undone. fold s.
    destruct (N.eqb_spec (place e) r), (N.ltb_spec (stored s) (after e)); cbn;
      intuition (try discriminate; try lia; auto). }
  (* the gate at work: what was sent is covered by storage *)
  assert (Sends : forall e k, In e (history w) -> what e = Sent k ->
            In e (filter (fun e => negb (undone w r e)) (history w))).
  { intros e k J W. apply Kept. split; auto. intros P. assert (E := events_ok w I e J).
    unfold event_ok in E. rewrite W, P in E. apply E. }
  split; cbn [robots network history lost now].
  - apply update_ind; [|apply (robots_ok w I)]. unfold robot_ok; cbn. repeat split; auto; lia.
  - intros e J. apply in_app_or in J as [J|[<-|[]]]; [|exact Left].
    apply Kept in J as [J L]. assert (E := events_ok w I e J). unfold event_ok in *.
    cbn [robots network]. destruct (what e); auto. destruct E as [E ?]. split; auto.
    unfold update. destruct (N.eqb_spec (place e) r); auto.
  - intros e J. apply in_app_or in J as [J|[<-|[]]].
    + apply Kept in J as [J L]. destruct (events_past w I e J). split; [lia|]. unfold update.
      destruct (N.eqb_spec (place e) r); [cbn; lia | lia].
    + cbn. rewrite update_same. cbn. lia.
  - intros e1 e2 J1 J2 T. apply in_app_or in J1 as [J1|[<-|[]]], J2 as [J2|[<-|[]]]; auto.
    + apply (one_event_a_time w I); auto; now apply Kept.
    + apply Kept in J1 as [J1 _]. destruct (events_past w I e1 J1). cbn in T. lia.
    + apply Kept in J2 as [J2 _]. destruct (events_past w I e2 J2). cbn in T. lia.
  - intros e1 e2 J1 J2 P T. apply in_app_or in J1 as [J1|[<-|[]]], J2 as [J2|[<-|[]]].
    + apply (robot_order w I); auto; now apply Kept.
    + apply Kept in J1 as [J1 L]. exact (L P).
    + apply Kept in J2 as [J2 _]. destruct (events_past w I e2 J2). cbn in T. lia.
    + cbn in T. lia.
  - intros e k gs J W. apply in_app_or in J as [J|[<-|[]]]; [|discriminate].
    apply Kept in J as [J _]. destruct (sent_before_received w I e k gs J W) as (e' & J' & S & ?).
    exists e'. repeat split; auto. apply in_or_app. eauto.
  - intros k m M. destruct (messages_were_sent w I k m M) as (e & J & S).
    exists e. split; auto. apply in_or_app. eauto.
  - intros k e1 e2 J1 J2 W1 W2.
    apply in_app_or in J1 as [J1|[<-|[]]]; [|discriminate].
    apply in_app_or in J2 as [J2|[<-|[]]]; [|discriminate].
    apply (sent_once w I k); auto; now apply Kept.
  - intros e k J W. apply in_app_or in J as [J|J]; [exact (sent_not_lost w I e k J W)|].
    apply filter_In in J as [J U]. specialize (Sends e k J W). apply filter_In in Sends as [_ S].
    rewrite U in S. discriminate.
Qed.

Lemma hear_invariant w r m how : invariant w ->
  (forall k, how <> Sent k) ->
  (forall new, let w' := commit w r new [] [event_now w r how new] in
     below (stamp m) (genes m) -> stamp m <= next (memory new) ->
     event_ok w' (event_now w r how new)) ->
  invariant (fst (hear gene_clocks l w r m how)).
Proof.
  intros I NotSent Ok.
  destruct (hear_cases w r m how) as [(new & L & ->)|(why & ->)]; [|exact I].
  apply learn_some in L as (Ok' & S & _ & _ & E & Low & _); [|apply (robots_ok w I)]. cbn [fst].
  apply commit_invariant; auto.
  - lia.
  - cbn. repeat split; lia.
  - intros e [<-|[]]. apply Ok; auto. lia.
  - left. split; auto. intros e k [<-|[]]. apply NotSent.
Qed.

Lemma step_invariant w c : invariant w -> invariant (fst (do l w c)).
Proof.
  intros I. destruct c as [r count|r selection|r k|r k|r m|r|r value|r anew];
    [..|now apply crash_invariant].
  - cbn [step]. destruct (robots_ok w I r) as (A & B & C & D).
    destruct (mint (own_limits l _) _ count) as [[first c]|] eqn:M; [|exact I]. cbn [fst].
    apply mint_some in M as (-> & E & F & G); cbn in *; try lia.
    apply commit_invariant; auto.
    + cbn. repeat split; cbn; try lia. intros gene J.
      apply in_app_or in J as [J|J]; [specialize (D _ J); cbn; lia|].
      apply in_minted_marks in J as (_ & J). cbn. lia.
    + cbn. lia.
    + apply minted_consecutive. cbn. lia.
    + intros e J. apply minted_event in J as (W & P & E' & L). unfold event_ok. rewrite W, P.
      repeat split; auto; lia.
    + left. split; auto. intros e k J. apply minted_event in J as (-> & _). discriminate.
  - cbn [step]. destruct (robots_ok w I r) as (A & B & C & D).
    cbn [may_send gene_clocks]. destruct (N.leb_spec (durable (memory (robots w r)))
      (stored (robots w r))) as [L|]; [|exact I]. cbn [fst]. set (m := Message _ _).
    apply commit_invariant; auto.
    + repeat split; auto; lia.
    + lia.
    + cbn. repeat split; lia.
    + intros e [<-|[]]. unfold event_ok, event_now. cbn [what place after network robots commit].
      rewrite update_same. split; [lia|]. exists m.
      rewrite nth_error_app2, Nat.sub_diag by auto. repeat split; auto.
      intros gene J. apply selected in J as [_ J]. now apply D.
    + right. exists m. eexists. repeat split.
  - cbn [step]. destruct (nth_error (network w) k) as [m|] eqn:M; [|exact I].
    apply hear_invariant; try discriminate; auto. intros new w' Low L. cbn. split.
    + intros gene J. specialize (Low gene J). lia.
    + exists m. rewrite app_nil_r. repeat split; auto.
  - cbn [step]. destruct (nth_error (network w) k) as [m|] eqn:M; [|exact I].
    apply hear_invariant; try discriminate; auto. intros new w' Low L. cbn in *. split; [intros _ []|].
    exists m. rewrite app_nil_r. repeat split; auto. intros _ [].
  - apply hear_invariant; try discriminate; auto. intros new w' Low L. cbn. intros gene J. specialize (Low gene J). lia.
  - cbn [step fst]. destruct (robots_ok w I r) as (A & B & C & D). apply commit_invariant; auto.
    + repeat split; cbn; auto; lia.
    + cbn. lia.
    + cbn. lia.
    + intros e [].
    + left. split; auto.
  - cbn [step]. destruct (robots_ok w I r) as (A & B & C & D).
    destruct (N.leb_spec value (maximum l)); [|exact I]. cbn [fst].
    apply commit_invariant; auto.
    + repeat split; cbn; auto; lia.
    + cbn. lia.
    + cbn. lia.
    + intros e [].
    + left. split; auto.
Qed.

Lemma in_genesis gene :
  In gene (genesis l) <-> maker gene = 0 /\ 1 <= counter gene <= genesis_count l.
Proof.
  unfold genesis. rewrite in_map_iff. split.
  - intros (i & <- & J). apply in_seq in J. cbn. lia.
  - intros (E & L). exists (N.to_nat (counter gene)). rewrite in_seq, N2Nat.id. split; [|lia].
    destruct gene; cbn in *. congruence.
Qed.

Lemma init_invariant : invariant (init l).
Proof.
  unfold valid in Valid. split; cbn; try tauto.
  - intros r. unfold robot_ok, fresh_robot, start; cbn. repeat split; try lia.
    intros gene J. apply in_genesis in J. lia.
  - intros k m. destruct k; discriminate.
Qed.

Lemma run_snoc commands c :
  after_all l (commands ++ [c]) = fst (do l (after_all l commands) c).
Proof. unfold run. now rewrite fold_left_app. Qed.

(** Induction over a run, one command at the end. *)
Lemma run_induction (P : list command -> world -> Prop) :
  P [] (init l) ->
  (forall commands c, invariant (after_all l commands) -> P commands (after_all l commands) ->
     P (commands ++ [c]) (fst (do l (after_all l commands) c))) ->
  forall commands, invariant (after_all l commands) /\ P commands (after_all l commands).
Proof.
  intros Init Step commands. induction commands as [|c commands [I H]] using rev_ind.
  - split; [apply init_invariant | exact Init].
  - rewrite run_snoc. split; [now apply step_invariant | now apply Step].
Qed.

Lemma run_invariant commands : invariant (after_all l commands).
Proof. now apply (run_induction (fun _ _ => True)). Qed.
End Invariant.

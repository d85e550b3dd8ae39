(** A trace that the checker accepts has unique marks and satisfies the clock condition. *)
From Coq Require Import NArith PeanoNat List Bool FMapPositive Lia.
From GeneClocks Require Import Mark Clock Trace.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Arithmetic.
Import ListNotations.
Open Scope N_scope.

Section TraceSafety.
Context (l : limits) (Valid : valid l).

(** ** The checker's tables *)

Lemma key_injective m n : key m = key n -> m = n.
Proof. unfold key. intros E. apply (f_equal Npos) in E. rewrite !N.succ_pos_spec in E. lia. Qed.

Lemma seat_of_sit c r s r' : seat_of l (sit c r s) r' = if r' =? r then s else seat_of l c r'.
Proof.
  unfold seat_of, sit; cbn. destruct (N.eqb_spec r' r) as [->|Ne].
  - now rewrite PositiveMap.gss.
  - rewrite PositiveMap.gso; auto. intros E. now apply Ne, key_injective.
Qed.

Lemma seat_of_sit_same c r s : seat_of l (sit c r s) r = s.
Proof. rewrite seat_of_sit. now rewrite N.eqb_refl. Qed.

(** ** One entry *)

Definition seat_ok (s : seat) : Prop :=
  start l <= next_of s <= maximum l /\ start l <= stored_of s <= maximum l.

(** What an accepted entry says of its robot, before and after, and of the table of stamps. *)
Definition effect (c : checker) (e : entry) (c' : checker) : Prop :=
  let s := seat_of l c (robot_of e) in let s' := seat_of l c' (robot_of e) in
  (forall r, r <> robot_of e -> seat_of l c' r = seat_of l c r) /\ seat_ok s' /\
  match e with
  | Mints _ first count => first = next_of s /\ next_of s' = first + count
      /\ stored_of s' = stored_of s /\ stamps c' = stamps c /\ sent c' = sent c
  | Sends _ stamp newest => stamp = next_of s /\ s' = s /\ stamp <= stored_of s
      /\ newest < stamp /\ stamps c' = PositiveMap.add (key (sent c)) stamp (stamps c)
      /\ sent c' = sent c + 1
  | Receives _ k next_after =>
      (exists stamp, PositiveMap.find (key k) (stamps c) = Some stamp
         /\ next_after = N.max (next_of s) stamp)
      /\ next_of s' = next_after /\ stored_of s' = stored_of s
      /\ stamps c' = stamps c /\ sent c' = sent c
  | Stores _ value => next_of s' = next_of s /\ stored_of s <= stored_of s'
      /\ stamps c' = stamps c /\ sent c' = sent c
  | Restarts _ next_after => next_after = stored_of s /\ next_of s' = next_after
      /\ stored_of s' = stored_of s /\ stamps c' = stamps c /\ sent c' = sent c
  end.

Lemma require_inl {A} condition otherwise (v : verdict A) a :
  require condition otherwise v = inl a -> condition = true /\ v = inl a.
Proof. unfold require. destruct condition; [auto | discriminate]. Qed.

Lemma check_entry_effect c e c' : seat_ok (seat_of l c (robot_of e)) ->
  check_entry l c e = inl c' -> effect c e c'.
Proof.
  intros (A & B). unfold effect, check_entry.
  assert (Others : forall r s, forall r', r' <> r -> seat_of l (sit c r s) r' = seat_of l c r').
  { intros r s r' Ne. rewrite seat_of_sit. now apply N.eqb_neq in Ne as ->. }
  destruct e as [r first count|r stamp newest|r k next_after|r value|r next_after];
    cbn [robot_of] in *.
  - intros H. apply require_inl in H as (E & H). apply N.eqb_eq in E as ->.
    destruct (mint l _ count) as [[f clock]|] eqn:M; [|discriminate]. injection H as <-.
    apply mint_some in M as (_ & N & D & _); cbn in *; try lia.
    rewrite seat_of_sit_same. unfold seat_ok. cbn. repeat split; auto; lia.
  - intros H. apply require_inl in H as (E & H). apply N.eqb_eq in E.
    apply require_inl in H as (S & H). apply N.leb_le in S.
    apply require_inl in H as (G & H). apply N.ltb_lt in G. injection H as <-.
    repeat split; auto; apply A || apply B.
  - destruct (PositiveMap.find (key k) (stamps c)) as [stamp|]; [|discriminate].
    destruct (observe l _ stamp) as [clock|] eqn:O; [|discriminate]. intros H.
    apply require_inl in H as (E & H). apply N.eqb_eq in E as ->. injection H as <-.
    apply observe_some in O as (N & D & _); cbn in *; try lia.
    rewrite seat_of_sit_same. unfold seat_ok. cbn. repeat split; eauto; lia.
  - intros H. apply require_inl in H as (E & H). apply andb_prop in E as (E1 & E2).
    apply N.leb_le in E1, E2. injection H as <-.
    rewrite seat_of_sit_same. unfold seat_ok. cbn. repeat split; auto; lia.
  - intros H. apply require_inl in H as (E & H). apply N.eqb_eq in E as ->. injection H as <-.
    rewrite seat_of_sit_same. unfold seat_ok. cbn. repeat split; auto; lia.
Qed.

(** ** Reading a trace that grows at its end *)

Lemma nth_error_snoc {A} (t : list A) e i x : nth_error (t ++ [e]) i = Some x ->
  (i < length t)%nat /\ nth_error t i = Some x \/ i = length t /\ x = e.
Proof.
  destruct (Nat.lt_trichotomy i (length t)) as [H|[->|H]]; intros E.
  - rewrite nth_error_app1 in E by assumption. auto.
  - rewrite nth_error_app2, Nat.sub_diag in E by auto. cbn in E. right. split; congruence.
  - assert (X : nth_error (t ++ [e]) i <> None) by congruence. apply nth_error_Some in X.
    rewrite app_length in X. cbn in X. lia.
Qed.

Lemma nth_error_old {A} (t : list A) e i : (i < length t)%nat ->
  nth_error (t ++ [e]) i = nth_error t i.
Proof. apply nth_error_app1. Qed.

Lemma nth_error_last {A} (t : list A) e : nth_error (t ++ [e]) (length t) = Some e.
Proof. rewrite nth_error_app2, Nat.sub_diag; auto. Qed.

Lemma shows_snoc t e i r n : shows (t ++ [e]) i r n ->
  (i < length t)%nat /\ shows t i r n \/ i = length t.
Proof.
  unfold shows. destruct (nth_error (t ++ [e]) i) as [x|] eqn:E; [|tauto].
  apply nth_error_snoc in E as [[H E]|[E _]]; [|tauto]. rewrite E. tauto.
Qed.

Lemma remembers_snoc t e r i j n : (j < length t)%nat ->
  remembers (t ++ [e]) r i j n -> remembers t r i j n.
Proof. intros L R k value B E. apply (R k); auto. now rewrite nth_error_old by lia. Qed.

Lemma remembers_last t e r i j n : (i < length t <= j)%nat -> remembers (t ++ [e]) r i j n ->
  remembers t r i (length t) n /\ forall value, e = Restarts r value -> n <= value.
Proof.
  intros L R. split.
  - intros k value B E. assert (k < length t)%nat by (apply nth_error_Some; congruence).
    apply (R k); [lia|]. now rewrite nth_error_old.
  - intros value ->. apply (R (length t)); [lia | apply nth_error_last].
Qed.

Lemma sent_before_old t e i : (i <= length t)%nat -> sent_before (t ++ [e]) i = sent_before t i.
Proof.
  intros L. unfold sent_before. rewrite firstn_app. replace (i - length t)%nat with O by lia.
  cbn. now rewrite app_nil_r.
Qed.

(** ** The invariant *)

Record tracked (t : list entry) (c : checker) : Prop := {
  seats_ok : forall r, seat_ok (seat_of l c r);
  remembered : forall i r n m, shows t i r n -> m <= n -> remembers t r i (length t) m ->
      m <= next_of (seat_of l c r);
  in_order : forall i j r n m n', shows t i r n -> m <= n -> shows t j r n' -> (i < j)%nat ->
      remembers t r i j m ->
      m <= n' /\ forall first count, nth_error t j = Some (Mints r first count) -> m <= first;
  numbers : sent c = N.of_nat (sent_before t (length t));
  stamps_numbered : forall k stamp, PositiveMap.find (key k) (stamps c) = Some stamp -> k < sent c;
  sends : forall i r stamp newest, nth_error t i = Some (Sends r stamp newest) ->
      PositiveMap.find (key (N.of_nat (sent_before t i))) (stamps c) = Some stamp
      /\ newest < stamp /\ stamp <= stored_of (seat_of l c r) /\ remembers t r i (length t) stamp;
  receptions : forall j r k n, nth_error t j = Some (Receives r k n) ->
      exists stamp, PositiveMap.find (key k) (stamps c) = Some stamp /\ stamp <= n
      /\ forall i r' stamp' newest, nth_error t i = Some (Sends r' stamp' newest) ->
           k = N.of_nat (sent_before t i) -> (i < j)%nat;
  mints_bounded : forall i r first count, nth_error t i = Some (Mints r first count) ->
      start l <= first /\ first + count <= maximum l
}.

Lemma tracked_init : tracked [] check_init.
Proof.
  assert (Empty : forall r, seat_of l check_init r = Seat (start l) (start l)).
  { intros r. unfold seat_of, check_init; cbn. now rewrite PositiveMap.gempty. }
  unfold valid in Valid. split; cbn; try (intros *; destruct i + destruct j; discriminate).
  - intros r. rewrite Empty. unfold seat_ok, start; cbn. lia.
  - intros i r n m H. unfold shows in H. destruct i; contradiction.
  - intros i j r n m n' H. unfold shows in H. destruct i; contradiction.
  - reflexivity.
  - intros k stamp H. rewrite PositiveMap.gempty in H. discriminate.
Qed.

(** Only its own restart brings a robot's clock down. *)
Lemma next_grows c e c' r : effect c e c' -> (forall value, e <> Restarts r value) ->
  next_of (seat_of l c r) <= next_of (seat_of l c' r).
Proof.
  intros (Others & _ & H) NoRestart. destruct (N.eq_dec r (robot_of e)) as [->|Ne];
    [|rewrite Others by assumption; lia].
  destruct e as [r' first count|r' stamp newest|r' k n|r' value|r' n]; cbn [robot_of] in *.
  - lia.
  - destruct H as (_ & -> & _). lia.
  - destruct H as ((stamp & _ & E) & E' & _). lia.
  - lia.
  - destruct (NoRestart n eq_refl).
Qed.

Lemma stored_grows c e c' r : effect c e c' ->
  stored_of (seat_of l c r) <= stored_of (seat_of l c' r).
Proof.
  intros (Others & _ & H). destruct (N.eq_dec r (robot_of e)) as [->|Ne];
    [|rewrite Others by assumption; lia].
  destruct e as [r' first count|r' stamp newest|r' k n|r' value|r' n]; cbn [robot_of] in *.
  - lia.
  - destruct H as (_ & -> & _). lia.
  - lia.
  - lia.
  - lia.
Qed.

(** A new entry shows its robot's clock as the checker has it. *)
Lemma shows_last t c e c' r n : effect c e c' -> shows (t ++ [e]) (length t) r n ->
  robot_of e = r /\ n = next_of (seat_of l c' r).
Proof.
  intros (_ & _ & H). unfold shows. rewrite nth_error_last.
  destruct e as [r' first count|r' stamp newest|r' k m|r' value|r' m]; cbn [robot_of] in *;
    intros S; try contradiction; destruct S as [<- ->]; (split; [reflexivity|]).
  - now destruct H as (_ & -> & _).
  - now destruct H as (-> & -> & _).
  - now destruct H as (_ & -> & _).
  - now destruct H as (_ & -> & _).
Qed.

Lemma stamps_grow c e c' k stamp : effect c e c' -> k < sent c ->
  PositiveMap.find (key k) (stamps c) = Some stamp ->
  PositiveMap.find (key k) (stamps c') = Some stamp.
Proof.
  intros (_ & _ & H) L F. destruct e; try (replace (stamps c') with (stamps c) by easy; exact F).
  destruct H as (_ & _ & _ & _ & -> & _). rewrite PositiveMap.gso; auto.
  intros E. apply key_injective in E. lia.
Qed.

Lemma tracked_step t c e c' : tracked t c -> check_entry l c e = inl c' -> tracked (t ++ [e]) c'.
Proof.
  intros T H. apply check_entry_effect in H; [|apply (seats_ok t c T)].
  assert (Numbers : sent c' = N.of_nat (sent_before (t ++ [e]) (length (t ++ [e])))).
  { unfold sent_before. rewrite firstn_all, filter_app, app_length. destruct H as (_ & _ & H).
    assert (N := numbers t c T). unfold sent_before in N. rewrite firstn_all in N.
    assert (Sent : sent c' = match e with Sends _ _ _ => sent c + 1 | _ => sent c end)
      by (destruct e; tauto).
    rewrite Sent. destruct e; cbn; lia. }
  split.
  - intros r. destruct (N.eq_dec r (robot_of e)) as [->|Ne]; [apply H|].
    destruct H as (Others & _). rewrite Others by assumption. apply (seats_ok t c T).
  - intros i r n m S L R. rewrite app_length in R. cbn in R.
    apply shows_snoc in S as S'. destruct S' as [[Li S']| ->].
    + apply remembers_last in R as [R Resets]; [|lia].
      assert (O := remembered t c T i r n m S' L R).
      destruct e as [| | | |r' value];
        try (assert (G := next_grows c _ c' r H ltac:(discriminate)); lia).
      destruct (N.eq_dec r' r) as [->|Ne].
      * specialize (Resets value eq_refl). destruct H as (_ & _ & _ & E & _). cbn [robot_of] in E. now rewrite E.
      * assert (G := next_grows c _ c' r H ltac:(congruence)). lia.
    + apply (shows_last t c e c') in S as [_ ->]; auto.
  - intros i j r n m n' Si L Sj Lt R.
    apply shows_snoc in Sj as Sj'. destruct Sj' as [[Lj Sj']| ->].
    + apply shows_snoc in Si as [[Li Si]| ->]; [|lia]. rewrite nth_error_old by assumption.
      apply (in_order t c T i j r n m n'); auto. now apply remembers_snoc in R.
    + apply shows_snoc in Si as [[Li Si]| ->]; [|lia].
      apply remembers_last in R as [R Resets]; [|lia].
      assert (O := remembered t c T i r n m Si L R). rewrite nth_error_last.
      apply (shows_last t c e c') in Sj as [Robot ->]; auto. split.
      * destruct e as [| | | |r' value];
          try (assert (G := next_grows c _ c' r H ltac:(discriminate)); lia).
        cbn in Robot. subst r'. specialize (Resets value eq_refl).
        destruct H as (_ & _ & _ & E & _). cbn [robot_of] in E. now rewrite E.
      * intros first count [= ->]. destruct H as (_ & _ & -> & _). exact O.
  - exact Numbers.
  - intros k stamp F. destruct H as (_ & _ & H).
    assert (Same : stamps c' = stamps c -> sent c' = sent c -> k < sent c').
    { intros E ->. rewrite E in F. exact (stamps_numbered t c T k stamp F). }
    destruct e; try (apply Same; tauto).
    destruct H as (_ & _ & _ & _ & E & ->). rewrite E in F.
    destruct (N.eq_dec k (sent c)) as [->|Ne]; [lia|].
    rewrite PositiveMap.gso in F by (intros X; now apply Ne, key_injective).
    assert (O := stamps_numbered t c T k stamp F). lia.
  - intros i r stamp newest E. assert (Last := E). rewrite app_length. cbn [length].
    apply nth_error_snoc in E as [[Li E]|[-> <-]].
    + destruct (sends t c T i r stamp newest E) as (F & Nw & St & R).
      rewrite sent_before_old by lia. split; [|split; [exact Nw|split]].
      * eapply stamps_grow; eauto. now apply (stamps_numbered t c T _ stamp).
      * assert (G := stored_grows c e c' r H). lia.
      * intros k value B X. apply nth_error_snoc in X as [[Lk X]|[-> X]].
        -- apply (R k value); [lia | exact X].
        -- subst e. destruct H as (_ & _ & -> & _). exact St.
    + destruct H as (_ & _ & H). cbn [robot_of] in H.
      destruct H as (_ & -> & St & Nw & -> & _). rewrite sent_before_old by lia.
      rewrite <- (numbers t c T). split; [apply PositiveMap.gss|]. repeat split; auto.
      intros k value B X. assert (k < length (t ++ [Sends r stamp newest]))%nat
        by (apply nth_error_Some; congruence). rewrite app_length in *. cbn in *. lia.
  - intros j r k n E. apply nth_error_snoc in E as [[Lj E]|[-> <-]].
    + destruct (receptions t c T j r k n E) as (stamp & F & L & First).
      assert (K := stamps_numbered t c T k stamp F).
      exists stamp. split; [eapply stamps_grow; eauto|]. split; auto.
      intros i r' stamp' newest X Ek. apply nth_error_snoc in X as [[Li X]|[-> <-]].
      * rewrite sent_before_old in Ek by lia. eapply First; eauto.
      * rewrite sent_before_old in Ek by lia. rewrite <- (numbers t c T) in Ek. lia.
    + destruct H as (_ & _ & (stamp & F & ->) & _ & _ & -> & _). exists stamp.
      split; [exact F|]. split; [lia|]. intros i r' stamp' newest X _.
      apply nth_error_snoc in X as [[Li X]|[-> X]]; [exact Li | discriminate].
  - intros i r first count E. apply nth_error_snoc in E as [[Li E]|[-> <-]].
    + exact (mints_bounded t c T i r first count E).
    + assert (Ok := seats_ok t c T r). destruct H as (_ & (Ok' & _) & -> & <- & _).
      cbn [robot_of] in *. destruct Ok. lia.
Qed.

Lemma check_from_snoc c position t e : check_from l c position (t ++ [e]) =
  match check_from l c position t with
  | inl c' => match check_entry l c' e with
              | inl c'' => inl c''
              | inr broken => inr ((position + length t)%nat, broken)
              end
  | inr broken => inr broken
  end.
Proof.
  revert c position. induction t as [|x t IH]; intros c position; cbn.
  - rewrite Nat.add_0_r. reflexivity.
  - destruct (check_entry l c x) as [c'|]; auto. rewrite IH.
    now replace (S position + length t)%nat with (position + S (length t))%nat by lia.
Qed.

Lemma accepted_tracked t c : check_trace l t = inl c -> tracked t c.
Proof.
  revert c. induction t as [|e t IH] using rev_ind; intros c H.
  - injection H as <-. apply tracked_init.
  - unfold check_trace in *. rewrite check_from_snoc in H.
    destruct (check_from l check_init 0 t) as [c'|]; [|discriminate].
    destruct (check_entry l c' e) as [c''|] eqn:E; [|discriminate]. injection H as <-.
    eapply tracked_step; eauto.
Qed.

(** ** Happened-before along a trace *)

Section Accepted.
Context (t : list entry) (c : checker) (T : tracked t c).

Lemma shows_one i r n r' n' : shows t i r n -> shows t i r' n' -> r = r' /\ n = n'.
Proof.
  unfold shows. destruct (nth_error t i) as [[]|]; intuition congruence.
Qed.

Lemma trace_before_mono i j : trace_before t i j -> exists r n r' n',
  shows t i r n /\ shows t j r' n' /\ (i < j)%nat /\ n <= n'
  /\ forall first count, nth_error t j = Some (Mints r' first count) -> n <= first.
Proof.
  induction 1 as [i j r n n' Si Sj L R|i j r stamp newest r' n Send_ Receive_|
                  i j k _ IH1 _ IH2].
  - exists r, n, r, n'. destruct (in_order t c T i j r n n n' Si) as (H & H'); auto; lia.
  - destruct (receptions t c T j r' _ n Receive_) as (stamp' & F & L & First).
    destruct (sends t c T i r stamp newest Send_) as (F' & _).
    assert (stamp' = stamp) as -> by congruence.
    exists r, stamp, r', n. unfold shows. rewrite Send_, Receive_. repeat split; auto.
    + eapply First; eauto.
    + discriminate.
  - destruct IH1 as (r1 & n1 & r2 & n2 & S1 & S2 & L & H & _).
    destruct IH2 as (r2' & n2' & r3 & n3 & S2' & S3 & L' & H' & M).
    destruct (shows_one j r2 n2 r2' n2' S2 S2') as [<- <-].
    exists r1, n1, r3, n3. repeat split; auto; try lia.
    intros first count E. specialize (M first count E). lia.
Qed.

Lemma mints_shows i gene : mints t i gene -> exists first count,
  nth_error t i = Some (Mints (maker gene) first count)
  /\ shows t i (maker gene) (first + count) /\ first <= counter gene < first + count.
Proof.
  intros (first & count & E & L). exists first, count. unfold shows. rewrite E. auto.
Qed.

Lemma no_second_mint i j gene : mints t i gene -> mints t j gene -> survives t i gene -> ~ (i < j)%nat.
Proof.
  intros Mi Mj S L. apply mints_shows in Mi as (f & n & Ei & Si & Li).
  apply mints_shows in Mj as (f' & n' & Ej & Sj & Lj).
  destruct (in_order t c T i j (maker gene) (f + n) (counter gene + 1) (f' + n')) as (_ & M); auto.
  - lia.
  - intros k value B E. apply (S k value); auto. split; [lia|].
    apply Nat.lt_le_incl, nth_error_Some. congruence.
  - specialize (M f' n' Ej). lia.
Qed.
End Accepted.
End TraceSafety.

Theorem trace_marks_unique : Claims.trace_marks_unique.
Proof.
  intros l t i j gene Valid (c & H) Mi. assert (T := accepted_tracked l Valid t c H). split.
  - destruct Mi as (first & count & E & L).
    destruct (mints_bounded l t c T i _ first count E). lia.
  - intros Mj Si Sj. assert (A := no_second_mint l t c T i j gene Mi Mj Si).
    assert (B := no_second_mint l t c T j i gene Mj Mi Sj). lia.
Qed.

Theorem trace_clock_condition : Claims.trace_clock_condition.
Proof.
  intros l t i j a b Valid (c & H) Before Mi Mj. assert (T := accepted_tracked l Valid t c H).
  destruct (trace_before_mono l t c T i j Before) as (r & n & r' & n' & Si & Sj & L & _ & M).
  apply mints_shows in Mi as (f & m & Ei & Si' & Li).
  apply mints_shows in Mj as (f' & m' & Ej & Sj' & Lj).
  destruct (shows_one t i _ _ _ _ Si Si') as [-> ->], (shows_one t j _ _ _ _ Sj Sj') as [-> _].
  specialize (M f' m' Ej). lia.
Qed.

Theorem trace_sends_survive : Claims.trace_sends_survive.
Proof.
  intros l t i r stamp newest Valid (c & H) E. assert (T := accepted_tracked l Valid t c H).
  now destruct (sends l t c T i r stamp newest E) as (_ & ? & _ & ?).
Qed.

(** Unique marks, the clock condition, exhaustion. *)
From Coq Require Import NArith PeanoNat List Bool Lia.
From GeneClocks Require Import Mark Clock Protocol.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order Arithmetic Invariant.
Import ListNotations.
Open Scope N_scope.

Lemma minting l w e gene : invariant l w -> makes w e gene ->
  gene = Mark (before e) (place e) /\ after e = before e + 1 /\ start l <= before e
  /\ after e <= maximum l.
Proof.
  intros I (J & W). assert (E := events_ok l w I e J). unfold event_ok in E. now rewrite W in E.
Qed.

Lemma made_once l w e1 e2 gene : invariant l w -> makes w e1 gene -> makes w e2 gene -> e1 = e2.
Proof.
  intros I M1 M2. destruct (minting l w e1 gene I M1) as (E1 & A1 & _).
  destruct (minting l w e2 gene I M2) as (E2 & A2 & _). rewrite E1 in E2. injection E2 as B P.
  destruct M1 as [J1 _], M2 as [J2 _].
  destruct (Nat.lt_trichotomy (time e1) (time e2)) as [T|[T|T]].
  - assert (L := robot_order l w I e1 e2 J1 J2 P T). lia.
  - now apply (one_event_a_time l w I).
  - assert (L := robot_order l w I e2 e1 J2 J1 (eq_sym P) T). lia.
Qed.

Theorem marks_unique : Claims.marks_unique.
Proof. intros l commands e1 e2 gene Valid w. apply (made_once l), run_invariant, Valid. Qed.

Lemma brought_below l w e gene : invariant l w -> In e (history w) -> brings e gene ->
  counter gene < after e.
Proof.
  intros I J B. assert (E := events_ok l w I e J). unfold event_ok in E. unfold brings in B.
  destruct (what e); try contradiction; [destruct E as [E _]|..]; now apply E.
Qed.

Lemma before_mono l w e1 e2 : invariant l w -> happened_before (history w) e1 e2 ->
  In e1 (history w) /\ In e2 (history w) /\ (time e1 < time e2)%nat /\ after e1 <= after e2.
Proof.
  intros I H. induction H as [e1 e2 J1 J2 P T|e1 e2 k gs J1 J2 S R|e1 e2 gene J1 J2 M B T|].
  - repeat split; auto. assert (L := robot_order l w I _ _ J1 J2 P T).
    destruct (events_past l w I e2 J2). lia.
  - assert (E1 := events_ok l w I e1 J1). assert (E2 := events_ok l w I e2 J2).
    unfold event_ok in E1, E2. rewrite S in E1. rewrite R in E2.
    destruct E1 as (_ & m & M1 & A1 & _), E2 as (_ & m' & M2 & A2 & _).
    replace m' with m in * by congruence.
    destruct (sent_before_received l w I e2 k gs J2 R) as (e' & J' & S' & T).
    rewrite (sent_once l w I k e1 e' J1 J' S S') in *. repeat split; auto. lia.
  - repeat split; auto. assert (L := brought_below l w e2 gene I J2 B).
    destruct (minting l w e1 gene I (conj J1 M)) as (-> & ? & _). cbn in L. lia.
  - intuition; lia.
Qed.

(** Causes reach an act of creation through its robot's clock. *)
Lemma before_creation l w e1 e2 gene : invariant l w -> happened_before (history w) e1 e2 ->
  what e2 = Minted gene -> after e1 <= before e2.
Proof.
  intros I H. induction H as [e1 e2 J1 J2 P T|e1 e2 k gs J1 J2 S R|e1 e2 g J1 J2 M B T|
                              e1 e2 e3 H1 _ H2 IH]; intros W.
  - exact (robot_order l w I _ _ J1 J2 P T).
  - congruence.
  - unfold brings in B. rewrite W in B. destruct B.
  - destruct (before_mono l w e1 e2 I H1) as (_ & _ & _ & L). specialize (IH W). lia.
Qed.

Lemma clocks_tell l w e1 e2 a b : invariant l w -> makes w e1 a -> makes w e2 b ->
  happened_before (history w) e1 e2 -> counter a < counter b.
Proof.
  intros I M1 M2 H. assert (L := before_creation l w e1 e2 b I H (proj2 M2)).
  destruct (minting l w e1 a I M1) as (-> & ? & _), (minting l w e2 b I M2) as (-> & ? & _).
  cbn. lia.
Qed.

Theorem clock_condition : Claims.clock_condition.
Proof. intros l commands e1 e2 a b Valid w. apply (clocks_tell l), run_invariant, Valid. Qed.

Theorem happened_before_irreflexive : Claims.happened_before_irreflexive.
Proof.
  intros l commands e Valid H.
  apply (before_mono l) in H as (_ & _ & T & _); [lia | now apply run_invariant].
Qed.

Theorem never_wraps : Claims.never_wraps.
Proof.
  intros l commands r Valid w s. assert (I := run_invariant l Valid commands). fold w in I.
  destruct (robots_ok l w I r) as (A & B & C & _). fold s in A, B, C.
  split; [lia|]. split; [lia|]. split; [lia|]. split.
  - intros e gene M. destruct (minting l w e gene I M) as (-> & ? & ? & ?). cbn. lia.
  - intros m M. apply In_nth_error in M as (k & M).
    destruct (messages_were_sent l w I k m M) as (e & J & S).
    assert (E := events_ok l w I e J). unfold event_ok in E. rewrite S in E.
    destruct E as (L & m' & M' & S' & _). replace m with m' by congruence.
    destruct (events_past l w I e J) as (_ & _ & L'), (robots_ok l w I (place e)) as (? & ? & _).
    lia.
Qed.

Theorem exhaustion_is_reported : Claims.exhaustion_is_reported.
Proof.
  intros l commands r count Valid w. assert (I := run_invariant l Valid commands). fold w in I.
  destruct (robots_ok l w I r) as (A & B & _).
  change (maximum l) with (maximum (own_limits l (robots w r))). rewrite <- mint_none by (cbn; lia).
  cbn [step]. destruct (mint _ _ count) as [[first c]|]; cbn; split; congruence.
Qed.

Theorem mint_all_or_nothing : Claims.mint_all_or_nothing.
Proof.
  intros l commands r count Valid w. assert (I := run_invariant l Valid commands). fold w in I.
  destruct (robots_ok l w I r) as (A & B & _). cbn [step].
  destruct (mint _ _ count) as [[first c]|] eqn:M; [right | now left].
  apply mint_some in M as (-> & E & _); cbn; try lia.
  eexists _, _. split; [reflexivity|]. cbn [robots commit]. rewrite update_same.
  split; [exact E|]. intros gene. cbn [history now]. split.
  - intros (e & (J & W) & T). cbn in J. apply in_app_or in J as [J|J].
    + destruct (events_past l w I e J). lia.
    + apply minted_event in J as (W' & _ & _ & L). rewrite W in W'. injection W' as ->. cbn.
      rewrite N2Nat.id in L. auto.
  - intros (P & L).
    assert (G : forall n id first, first <= counter gene < first + N.of_nat n ->
              exists e, In e (minted_events id r first n) /\ what e = Minted gene /\ (id <= time e)%nat).
    { clear -P. induction n as [|n IH]; intros id first L; [lia|]. cbn [minted_events].
      destruct (N.eq_dec (counter gene) first) as [<-|].
      - eexists. split; [now left|]. cbn. rewrite <- P. destruct gene. auto.
      - destruct (IH (S id) (first + 1)) as (e & J & W & T); [lia|]. exists e. cbn. auto with arith. }
    destruct (G (N.to_nat count) (now w) (next (memory (robots w r)))) as (e & J & W & T); [lia|].
    exists e. repeat split; auto. cbn. apply in_or_app. auto.
Qed.

Theorem new_gene_is_last : Claims.new_gene_is_last.
Proof.
  intros l commands r count w' first old new Valid w. assert (I := run_invariant l Valid commands).
  fold w in I. destruct (robots_ok l w I r) as (A & B & C & D). cbn [step].
  destruct (mint _ _ count) as [[first' c]|] eqn:M; [|discriminate]. intros [= <- <-] K L.
  apply mint_some in M as (-> & _); cbn; try lia. apply counter_decides. specialize (D old K). lia.
Qed.

Theorem genesis_disjoint : Claims.genesis_disjoint.
Proof.
  intros l commands e gene Valid M G. apply in_genesis in G as (_ & G).
  apply (minting l) in M as (-> & _ & L & _); [|now apply run_invariant].
  unfold start in L. cbn in *. lia.
Qed.

Theorem refusal_changes_nothing : Claims.refusal_changes_nothing.
Proof.
  intros l w c. destruct c as [r count|r selection|r k|r k|r m|r|r value|r anew]; cbn [step].
  - destruct (mint _ _ count) as [[? ?]|]; cbn; auto.
  - destruct (may_send _ _); cbn; auto.
  - destruct (nth_error _ k) as [m|]; [|reflexivity].
    unfold hear. now destruct (learn _ _ _ _ m).
  - destruct (nth_error _ k) as [m|]; [|reflexivity]. unfold hear. now destruct (learn _ _ _ _ _).
  - unfold hear. now destruct (learn _ _ _ _ m).
  - cbn. auto.
  - destruct (value <=? _); cbn; auto.
  - destruct (resume _ _ _); cbn; auto.
Qed.

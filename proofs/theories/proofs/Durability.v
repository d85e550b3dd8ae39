(** What storage and the gate before every message guarantee. *)
From Coq Require Import NArith PeanoNat List Bool Lia.
From GeneClocks Require Import Mark Clock Protocol.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order Arithmetic Invariant Safety.
Import ListNotations.
Open Scope N_scope.

Theorem nothing_sent_is_forgotten : Claims.nothing_sent_is_forgotten.
Proof.
  intros l commands e k Valid w W. assert (I := run_invariant l Valid commands). fold w in I.
  split.
  - intros J. exact (sent_not_lost l w I e k J W).
  - intros J. assert (E := events_ok l w I e J). unfold event_ok in E. rewrite W in E.
    destruct E as (L & m & M & S & Low). split; auto. exists m. auto.
Qed.

(** No crash brings a robot's clock below this. *)
Definition floor (s : robot) : N := N.min (next (memory s)) (stored s).

Lemma floor_never_sinks l w c r : invariant l w ->
  floor (robots w r) <= floor (robots (fst (do l w c)) r).
Proof.
  intros I. assert (Update : forall r' new, floor (robots w r') <= floor new ->
              floor (robots w r) <= floor (update (robots w) r' new r)).
  { intros r' new L. unfold update. destruct (N.eqb_spec r r') as [->|]; auto. lia. }
  unfold floor in *.
  destruct c as [r' count|r' selection|r' k|r' m|r' value|r']; cbn [step];
    destruct (robots_ok l w I r') as (A & B & C & D).
  - destruct (mint l _ count) as [[first c]|] eqn:M; [|cbn; lia].
    apply mint_some in M as (-> & E & _); try lia. apply Update. cbn. lia.
  - destruct (may_send _ _); [|cbn; lia]. apply Update. cbn. lia.
  - destruct (nth_error _ k) as [m|]; [|cbn; lia].
    destruct (learn _ l _ m) as [new|] eqn:L; [|cbn; lia].
    apply (learn_some l) in L as (_ & S & _ & E & _); [|apply (robots_ok l w I)].
    apply Update. lia.
  - destruct (learn _ l _ m) as [new|] eqn:L; [|cbn; lia].
    apply (learn_some l) in L as (_ & S & _ & E & _); [|apply (robots_ok l w I)].
    apply Update. lia.
  - destruct (value <=? _); [|cbn; lia]. apply Update. cbn. lia.
  - apply Update. cbn. lia.
Qed.

(** An event of the next step starts no lower than the floor. *)
Lemma new_event_above_floor l w c e : invariant l w -> In e (history (fst (do l w c))) ->
  In e (history w) \/ floor (robots w (place e)) <= before e.
Proof.
  intros I. unfold floor.
  destruct c as [r count|r selection|r k|r m|r value|r]; cbn [step];
    destruct (robots_ok l w I r) as (A & B & C & D).
  - destruct (mint l _ count) as [[first c]|] eqn:M; [|now left].
    apply mint_some in M as (-> & _); try lia. intros J.
    apply in_app_or in J as [J|J]; [now left | right].
    apply minted_event in J as (_ & -> & _ & L). lia.
  - destruct (may_send _ _); [|now left]. intros J.
    apply in_app_or in J as [J|[<-|[]]]; [now left | right]. cbn. lia.
  - destruct (nth_error _ k) as [m|]; [|now left].
    destruct (learn _ l _ m) as [new|]; [|now left]. intros J.
    apply in_app_or in J as [J|[<-|[]]]; [now left | right]. cbn. lia.
  - destruct (learn _ l _ m) as [new|]; [|now left]. intros J.
    apply in_app_or in J as [J|[<-|[]]]; [now left | right]. cbn. lia.
  - destruct (value <=? _); [|now left]. intros J. cbn in J. rewrite app_nil_r in J. now left.
  - intros J. cbn in J. apply in_app_or in J as [J|[<-|[]]]; [left | right; cbn; lia].
    apply filter_In in J. apply J.
Qed.

Lemma after_crash l earlier r later : valid l ->
  let crashed := after_all l (earlier ++ [Crash r]) in
  let w := after_all l (earlier ++ [Crash r] ++ later) in
  next (memory (robots crashed r)) <= floor (robots w r)
  /\ forall e, In e (history w) -> place e = r -> (now crashed <= time e)%nat ->
       next (memory (robots crashed r)) <= before e.
Proof.
  intros Valid crashed. cbn zeta.
  assert (I : invariant l crashed) by now apply run_invariant.
  induction later as [|c later [IH1 IH2]] using rev_ind.
  - rewrite app_nil_r. fold crashed. split.
    + unfold crashed. rewrite run_snoc. unfold floor. cbn. rewrite update_same. cbn. lia.
    + intros e J _ T. destruct (events_past l crashed I e J). lia.
  - rewrite !app_assoc in *. rewrite run_snoc.
    set (w := after_all l ((earlier ++ [Crash r]) ++ later)) in *.
    assert (I' : invariant l w) by now apply run_invariant.
    split.
    + assert (L := floor_never_sinks l w c r I'). lia.
    + intros e J P T. apply new_event_above_floor in J as [J|L]; auto. subst r. lia.
Qed.

Theorem restart_is_safe : Claims.restart_is_safe.
Proof.
  intros l earlier r later e gene Valid crashed w M P T.
  assert (I : invariant l crashed) by now apply run_invariant.
  assert (I' : invariant l w) by now apply run_invariant.
  assert (L : next (memory (robots crashed r)) <= counter gene).
  { destruct (minting l w e gene I' M) as (-> & _).
    destruct (after_crash l earlier r later Valid) as (_ & L). apply L; auto. apply M. }
  split; [|split].
  - intros old K. apply counter_decides. destruct (robots_ok l crashed I r) as (_ & _ & _ & D).
    specialize (D old K). lia.
  - intros e' J <-. destruct (events_past l crashed I e' J). lia.
  - intros e' old M' ->. destruct (minting l w e gene I' M) as (E & _).
    destruct (minting l crashed e' gene I M') as (E' & A & _). destruct M' as (J & _).
    destruct (events_past l crashed I e' J) as (_ & _ & L'). rewrite E in E'.
    injection E' as B P'. rewrite <- P', P in L'. rewrite E in L. cbn in L. lia.
Qed.

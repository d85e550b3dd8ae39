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
  assert (Hear : forall r' m how, floor (robots w r)
            <= floor (robots (fst (hear gene_clocks l w r' m how)) r)).
  { intros r' m how. destruct (hear_cases l w r' m how) as [(new & L & ->)|(why & ->)]; [|cbn; lia].
    apply (learn_some l) in L as (_ & S & _ & _ & E & _); [|apply (robots_ok l w I)].
    apply Update. unfold floor. lia. }
  unfold floor in *.
  destruct c as [r' count|r' selection|r' k|r' k|r' m|r'|r' value|r' anew]; cbn [step];
    destruct (robots_ok l w I r') as (A & B & C & D).
  - destruct (mint _ _ count) as [[first c]|] eqn:M; [|cbn; lia].
    apply mint_some in M as (-> & E & _); cbn; try lia. apply Update. cbn. lia.
  - destruct (may_send _ _); [|cbn; lia]. apply Update. cbn. lia.
  - destruct (nth_error _ k) as [m|]; [apply Hear | cbn; lia].
  - destruct (nth_error _ k) as [m|]; [apply Hear | cbn; lia].
  - apply Hear.
  - apply Update. cbn. lia.
  - destruct (value <=? _); [|cbn; lia]. apply Update. cbn. lia.
  - rewrite resumes by apply (robots_ok l w I). apply Update. cbn. lia.
Qed.

(** An event of the next step starts no lower than the floor. *)
Lemma new_event_above_floor l w c e : invariant l w -> In e (history (fst (do l w c))) ->
  In e (history w) \/ floor (robots w (place e)) <= before e.
Proof.
  intros I. assert (Hear : forall r m how, In e (history (fst (hear gene_clocks l w r m how))) ->
            In e (history w) \/ floor (robots w (place e)) <= before e).
  { intros r m how. destruct (hear_cases l w r m how) as [(new & _ & ->)|(why & ->)]; [|now left].
    intros J. apply in_app_or in J as [J|[<-|[]]]; [now left | right]. unfold floor. cbn. lia. }
  unfold floor in *.
  destruct c as [r count|r selection|r k|r k|r m|r|r value|r anew]; cbn [step];
    destruct (robots_ok l w I r) as (A & B & C & D).
  - destruct (mint _ _ count) as [[first c]|] eqn:M; [|now left].
    apply mint_some in M as (-> & _); cbn; try lia. intros J.
    apply in_app_or in J as [J|J]; [now left | right].
    apply minted_event in J as (_ & -> & _ & L). lia.
  - destruct (may_send _ _); [|now left]. intros J.
    apply in_app_or in J as [J|[<-|[]]]; [now left | right]. cbn. lia.
  - destruct (nth_error _ k) as [m|]; [apply Hear | now left].
  - destruct (nth_error _ k) as [m|]; [apply Hear | now left].
  - apply Hear.
  - intros J. cbn in J. rewrite app_nil_r in J. now left.
  - destruct (value <=? _); [|now left]. intros J. cbn in J. rewrite app_nil_r in J. now left.
  - rewrite resumes by apply (robots_ok l w I).
    intros J. cbn in J. apply in_app_or in J as [J|[<-|[]]]; [left | right; cbn; lia].
    apply filter_In in J. apply J.
Qed.

Lemma after_crash l earlier r anew later : valid l ->
  let crashed := after_all l (earlier ++ [Crash r anew]) in
  let w := after_all l (earlier ++ [Crash r anew] ++ later) in
  next (memory (robots crashed r)) <= floor (robots w r)
  /\ forall e, In e (history w) -> place e = r -> (now crashed <= time e)%nat ->
       next (memory (robots crashed r)) <= before e.
Proof.
  intros Valid crashed. cbn zeta.
  assert (I : invariant l crashed) by now apply run_invariant.
  induction later as [|c later [IH1 IH2]] using rev_ind.
  - rewrite app_nil_r. fold crashed. split.
    + unfold crashed. rewrite run_snoc. unfold floor. cbn [step].
      rewrite resumes by apply (robots_ok l _ (run_invariant l Valid earlier)).
      cbn. rewrite update_same. cbn. lia.
    + intros e J _ T. destruct (events_past l crashed I e J). lia.
  - rewrite !app_assoc in *. rewrite run_snoc.
    set (w := after_all l ((earlier ++ [Crash r anew]) ++ later)) in *.
    assert (I' : invariant l w) by now apply run_invariant.
    split.
    + assert (L := floor_never_sinks l w c r I'). lia.
    + intros e J P T. apply new_event_above_floor in J as [J|L]; auto. subst r. lia.
Qed.

Theorem restart_is_safe : Claims.restart_is_safe.
Proof.
  intros l earlier r anew later e gene Valid crashed w M P T.
  assert (I : invariant l crashed) by now apply run_invariant.
  assert (I' : invariant l w) by now apply run_invariant.
  assert (L : next (memory (robots crashed r)) <= counter gene).
  { destruct (minting l w e gene I' M) as (-> & _).
    destruct (after_crash l earlier r anew later Valid) as (_ & L). apply L; auto. apply M. }
  split; [|split].
  - intros old K. apply counter_decides. destruct (robots_ok l crashed I r) as (_ & _ & _ & D).
    specialize (D old K). lia.
  - intros e' J <-. destruct (events_past l crashed I e' J). lia.
  - intros e' old M' ->. destruct (minting l w e gene I' M) as (E & _).
    destruct (minting l crashed e' gene I M') as (E' & A & _). destruct M' as (J & _).
    destruct (events_past l crashed I e' J) as (_ & _ & L'). rewrite E in E'.
    injection E' as B P'. rewrite <- P', P in L'. rewrite E in L. cbn in L. lia.
Qed.

Theorem crash_is_survived : Claims.crash_is_survived.
Proof.
  intros l commands r anew Valid w. assert (I := run_invariant l Valid commands). fold w in I.
  cbn [step]. rewrite resumes by apply (robots_ok l w I). split; [reflexivity|].
  cbn. now rewrite update_same.
Qed.

Theorem snapshot_is_exact : Claims.snapshot_is_exact.
Proof.
  intros l commands r Valid c. assert (I := run_invariant l Valid commands).
  destruct (robots_ok l _ I r) as (A & B & _). fold c in A, B.
  destruct (restore_admits l (next c) (durable c)) as (R & _). unfold start in A.
  rewrite R by lia. now destruct c.
Qed.

(** How far counters can get, and whom the admission window refuses. *)
From Coq Require Import NArith PeanoNat List Bool Lia.
From GeneClocks Require Import Mark Clock Protocol.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order Arithmetic Invariant Safety.
Import ListNotations.
Open Scope N_scope.

Lemma budget_snoc l commands c :
  Claims.budget l (commands ++ [c]) = Claims.budget l commands + Claims.cost l c.
Proof.
  unfold Claims.budget. induction commands as [|c' commands IH]; cbn [app fold_right].
  - lia.
  - rewrite IH. lia.
Qed.

(** No clock and no message is beyond [total]. *)
Definition within (l : limits) (total : N) (w : world) : Prop :=
  (forall r, next (memory (robots w r)) <= total
     /\ durable (memory (robots w r)) <= next (memory (robots w r)) + block l)
  /\ forall m, In m (network w) -> stamp m <= total.

Lemma step_within l w c total : invariant l w -> within l total w ->
  within l (total + Claims.cost l c) (fst (do l w c)).
Proof.
  intros I (R & M).
  assert (Same : within l (total + Claims.cost l c) w).
  { split; [intros r; destruct (R r) | intros m J; specialize (M m J)]; lia. }
  assert (Commit : forall r new sent es, next (memory new) <= total + Claims.cost l c ->
            durable (memory new) <= next (memory new) + block l ->
            (forall m, In m sent -> stamp m <= total) ->
            within l (total + Claims.cost l c) (commit w r new sent es)).
  { intros r new sent es A B C. split; cbn [robots network commit].
    - intros r'. unfold update. destruct (R r'), (r' =? r); lia.
    - intros m J. apply in_app_or in J as [J|J]; [specialize (M m J) | specialize (C m J)]; lia. }
  destruct c as [r count|r selection|r k|r m|r value|r]; cbn [step Claims.cost] in *;
    destruct (robots_ok l w I r) as (A & B & C & D), (R r) as (E & F).
  - destruct (mint l _ count) as [[first c]|] eqn:H; [|exact Same].
    apply mint_some in H as (_ & G & _ & ?); try lia. apply Commit; cbn; try tauto; lia.
  - destruct (may_send _ _); [|exact Same]. apply Commit; try lia.
    intros m [<-|[]]. cbn. lia.
  - destruct (nth_error _ k) as [m|] eqn:K; [|exact Same].
    destruct (learn _ l _ m) as [new|] eqn:L; [|exact Same].
    apply (learn_some l) in L as (_ & _ & _ & G & _ & _ & ?); [|apply (robots_ok l w I)].
    apply nth_error_In, M in K. apply Commit; cbn; try tauto; lia.
  - destruct (learn _ l _ m) as [new|] eqn:L; [|exact Same].
    apply (learn_some l) in L as (_ & _ & _ & G & _ & ? & ?); [|apply (robots_ok l w I)].
    apply Commit; cbn; try tauto; lia.
  - destruct (value <=? _); [|exact Same]. apply Commit; cbn; try tauto; lia.
  - split; cbn [fst robots network].
    + intros r'. unfold update. destruct (R r'), (r' =? r); cbn; lia.
    + intros m J. specialize (M m J). lia.
Qed.

Lemma run_within l commands : valid l ->
  within l (Claims.budget l commands) (after_all l commands).
Proof.
  intros Valid.
  apply (run_induction l Valid (fun commands w => within l (Claims.budget l commands) w)).
  - split; cbn; [intros; lia | tauto].
  - intros cs c I W. rewrite budget_snoc. now apply step_within.
Qed.

Theorem counter_budget : Claims.counter_budget.
Proof. intros l commands r Valid. apply (run_within l commands Valid). Qed.

Theorem honest_never_refused : Claims.honest_never_refused.
Proof.
  intros l commands r k Valid Budget K. assert (I := run_invariant l Valid commands).
  destruct (run_within l commands Valid) as (_ & M).
  set (w := after_all l commands) in *. cbn [step].
  destruct (nth_error (network w) k) as [m|] eqn:H;
    [|apply nth_error_Some in K; contradiction].
  destruct (messages_were_sent l w I k m H) as (e & J & S).
  assert (E := events_ok l w I e J). unfold event_ok in E. rewrite S in E.
  destruct E as (L & m' & H' & A & Low). replace m' with m in * by congruence.
  destruct (robots_ok l w I (place e)) as (_ & X & Y & _).
  destruct (robots_ok l w I r) as (X' & _).
  specialize (M m (nth_error_In _ _ H)).
  unfold learn. cbn [credible merge gene_clocks].
  replace (forallb _ _) with true.
  2:{ symmetry. apply forallb_forall. intros gene G. apply N.ltb_lt, Low, G. }
  destruct (observe l (memory (robots w r)) (stamp m)) as [c|] eqn:O; [reflexivity|].
  apply observe_none in O. lia.
Qed.

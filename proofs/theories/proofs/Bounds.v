(** How far counters can get, and whom the admission window refuses. *)
From Coq Require Import NArith PeanoNat List Bool Lia.
From GeneClocks Require Import Mark Clock Admission Protocol.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order Arithmetic Invariant Safety.
Import ListNotations.
Open Scope N_scope.

Lemma budget_snoc l commands c :
  Claims.budget_with_storing l (commands ++ [c])
  = Claims.budget_with_storing l commands + Claims.cost l (after_all l commands) c.
Proof.
  unfold Claims.budget_with_storing, run. generalize (init l).
  induction commands as [|c' commands IH]; intros w; cbn [app Claims.spent fold_left].
  - lia.
  - specialize (IH (fst (do l w c'))). lia.
Qed.

(** No clock, no storage and no message is beyond [total], but for what is reserved. *)
Definition within (l : limits) (total : N) (w : world) : Prop :=
  (forall r, let s := robots w r in next (memory s) <= total
     /\ durable (memory s) <= total + block_of s /\ stored s <= total + block_of s)
  /\ forall m, In m (network w) -> stamp m <= total.

Lemma step_within l w c total : invariant l w -> within l total w ->
  within l (total + Claims.cost l w c) (fst (do l w c)).
Proof.
  intros I (R & M).
  assert (Same : within l (total + Claims.cost l w c) w).
  { split; [intros r; destruct (R r) as (? & ? & ?) | intros m J; specialize (M m J)]; cbn; lia. }
  assert (Commit : forall r new sent es, next (memory new) <= total + Claims.cost l w c ->
            durable (memory new) <= total + Claims.cost l w c + block_of new ->
            stored new <= total + Claims.cost l w c + block_of new ->
            (forall m, In m sent -> stamp m <= total) ->
            within l (total + Claims.cost l w c) (commit w r new sent es)).
  { intros r new sent es A B S C. split; cbn [robots network commit].
    - intros r'. unfold update. destruct (R r') as (? & ? & ?), (r' =? r); lia.
    - intros m J. apply in_app_or in J as [J|J]; [specialize (M m J) | specialize (C m J)]; lia. }
  assert (Hear : forall r m how,
            stamp m <= next (memory (robots w r)) + Claims.cost l w c \/ stamp m <= total ->
            within l (total + Claims.cost l w c) (fst (hear gene_clocks l w r m how))).
  { intros r m how Low. destruct (R r) as (? & ? & ?).
    destruct (hear_cases l w r m how) as [(new & L & ->)|(why & ->)]; [|exact Same].
    apply (learn_some l) in L as (_ & S & _ & B & G & _ & _ & ?); [|apply (robots_ok l w I)].
    apply Commit; cbn; try tauto; lia. }
  destruct c as [r count|r selection|r k|r k|r m|r|r value|r anew]; cbn [step Claims.cost] in *;
    destruct (robots_ok l w I r) as (A & B & C & D), (R r) as (E & F & G).
  - destruct (mint _ _ count) as [[first c]|] eqn:H; [|exact Same].
    apply mint_some in H as (_ & K & _ & ?); cbn in *; try lia. apply Commit; cbn; try tauto; lia.
  - destruct (may_send _ _); [|exact Same]. apply Commit; try lia.
    intros m [<-|[]]. cbn. lia.
  - destruct (nth_error _ k) as [m|] eqn:K; [|exact Same].
    apply nth_error_In, M in K. apply Hear. now right.
  - destruct (nth_error _ k) as [m|] eqn:K; [|exact Same].
    apply nth_error_In, M in K. apply Hear. now right.
  - destruct (hear_cases l w r m (Injected (genes m))) as [(new & L & ->)|(why & ->)];
      [|exact Same].
    apply (learn_some l) in L as (_ & S & _ & X & Y & _ & ? & ?); [|apply (robots_ok l w I)].
    apply Commit; cbn; try tauto; lia.
  - apply Commit; cbn; try tauto; lia.
  - destruct (value <=? _); [|exact Same]. apply Commit; cbn; try tauto; lia.
  - rewrite resumes by apply (robots_ok l w I). split; cbn [fst robots network].
    + intros r'. unfold update. destruct (R r') as (? & ? & ?), (r' =? r); cbn; lia.
    + intros m J. specialize (M m J). lia.
Qed.

Lemma run_within l commands : valid l ->
  within l (Claims.budget_with_storing l commands) (after_all l commands).
Proof.
  intros Valid.
  apply (run_induction l Valid (fun commands w =>
    within l (Claims.budget_with_storing l commands) w)).
  - unfold Claims.budget_with_storing. split; cbn; [intros; lia | tauto].
  - intros cs c I W. rewrite budget_snoc. now apply step_within.
Qed.

Theorem counter_budget : Claims.counter_budget.
Proof. intros l commands r Valid. apply (run_within l commands Valid). Qed.

Theorem stored_budget : Claims.stored_budget.
Proof.
  intros l commands r Valid w. destruct (run_within l commands Valid) as (R & M).
  split; [exact M | apply R].
Qed.

(** What is said of a message that was sent. *)
Lemma sent_properly l w k m : invariant l w -> nth_error (network w) k = Some m ->
  credible gene_clocks m = true /\ stamp m <= maximum l.
Proof.
  intros I K. destruct (messages_were_sent l w I k m K) as (e & J & S).
  assert (E := events_ok l w I e J). unfold event_ok in E. rewrite S in E.
  destruct E as (L & m' & K' & A & Low). replace m' with m in * by congruence. split.
  - apply forallb_forall. intros gene G. apply N.ltb_lt, Low, G.
  - destruct (robots_ok l w I (place e)) as (_ & _ & Y & _). lia.
Qed.

Theorem honest_never_refused : Claims.honest_never_refused.
Proof.
  intros l commands r k Valid Budget w Bare K. assert (I := run_invariant l Valid commands).
  destruct (run_within l commands Valid) as (_ & M). fold w in I, M. cbn [step].
  destruct (nth_error (network w) k) as [m|] eqn:H;
    [|apply nth_error_Some in K; contradiction].
  destruct (sent_properly l w k m I H) as (Covered & Top).
  destruct (robots_ok l w I r) as (X & _). specialize (M m (nth_error_In _ _ H)).
  unfold hear, learn. rewrite Covered, Bare. cbn [merge gene_clocks].
  destruct (observe _ (memory (robots w r)) (stamp m)) as [c|] eqn:O; [reflexivity|].
  apply observe_none in O. cbn in O. lia.
Qed.

(** The sum of clock and allowance: receptions leave it, own genes and time raise it. *)
From Coq Require Import NArith PeanoNat List Bool Lia.
From GeneClocks Require Import Mark Clock Admission Protocol.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order Arithmetic Invariant Safety Provenance Bounds.
Import ListNotations.
Open Scope N_scope.

Local Opaque N.add N.sub N.mul N.min N.max.

Section Life.
Context (l : limits) (Valid : valid l) (r : N) (p : policy).

(** What one command may do to the gate of [r], and to how far receptions could get the clock. *)
Definition grows (s s' : robot) (own time : N) : Prop :=
  forall g, guard s = Some g -> law g = p -> exists g', guard s' = Some g' /\ law g' = p
    /\ next (memory s') + allowance g' <= next (memory s) + allowance g + own + per_cycle p * time
    /\ allowance g' <= allowance g + per_cycle p * time
    /\ (allowance g + per_cycle p * time <= ceiling p ->
        next (memory s) + allowance g + per_cycle p * time <= next (memory s') + allowance g').

Lemma unchanged s own : grows s s own 0.
Proof. intros g G L. exists g. repeat split; auto; lia. Qed.

Lemma hear_grows w r' m how : invariant l w ->
  grows (robots w r) (robots (fst (hear gene_clocks l w r' m how)) r) 0 0.
Proof.
  intros I. destruct (hear_cases l w r' m how) as [(new & L & ->)|(why & ->)]; [|apply unchanged].
  cbn [fst robots commit]. unfold update. destruct (N.eqb_spec r r') as [<-|]; [|apply unchanged].
  intros g G Law. unfold learn in L. rewrite G in L. destruct (credible _ m); [|discriminate].
  cbn [gated gene_clocks] in L.
  destruct (pass _ r _ g _ _) as [[c g']|] eqn:A; [|discriminate]. injection L as <-.
  apply pass_some in A as (O & Law' & Sum). apply observe_is_maximum in O.
  exists g'. cbn. repeat split; auto; [congruence|..]; lia.
Qed.

Lemma step_grows w c : invariant l w -> (forall anew, c <> Crash r anew) ->
  grows (robots w r) (robots (fst (do l w c)) r) (Claims.own_genes r [c]) (Claims.cycles r [c]).
Proof.
  intros I Alive.
  destruct c as [r' count|r' selection|r' k|r' k|r' m|r'|r' value|r' anew];
    cbn [step Claims.own_genes Claims.cycles fold_right].
  - replace (if r' =? r then count + 0 else 0) with (if r =? r' then count else 0)
      by (rewrite (N.eqb_sym r r'); destruct (r' =? r); lia).
    destruct (mint _ _ count) as [[first c]|] eqn:M; [|apply unchanged].
    destruct (robots_ok l w I r') as (A & B & _).
    apply mint_some in M as (_ & E & _); cbn; try lia.
    unfold update. destruct (N.eqb_spec r r') as [<-|]; [|apply unchanged].
    intros g G Law. exists g. cbn. repeat split; auto; lia.
  - destruct (may_send _ _); [|apply unchanged]. cbn. unfold update.
    destruct (N.eqb_spec r r') as [<-|]; apply unchanged.
  - destruct (nth_error _ k); [now apply hear_grows | apply unchanged].
  - destruct (nth_error _ k); [now apply hear_grows | apply unchanged].
  - now apply hear_grows.
  - cbn. unfold update. rewrite (N.eqb_sym r' r).
    destruct (N.eqb_spec r r') as [<-|]; [|apply unchanged].
    intros g G Law. exists (elapse g). cbn. rewrite G. cbn. unfold earn. rewrite Law.
    repeat split; auto; lia.
  - destruct (value <=? _); [|apply unchanged]. cbn. unfold update.
    destruct (N.eqb_spec r r') as [<-|]; [|apply unchanged].
    intros g G Law. exists g. cbn. repeat split; auto; lia.
  - rewrite resumes by apply (robots_ok l w I). cbn. unfold update.
    destruct (N.eqb_spec r r') as [<-|]; [now destruct (Alive anew) | apply unchanged].
Qed.

Lemma cons_own c commands :
  Claims.own_genes r (c :: commands) = Claims.own_genes r [c] + Claims.own_genes r commands.
Proof. unfold Claims.own_genes, Claims.cycles. cbn [fold_right]. destruct c; try lia. all: destruct (_ =? r); lia. Qed.

Lemma cons_cycles c commands :
  Claims.cycles r (c :: commands) = Claims.cycles r [c] + Claims.cycles r commands.
Proof. unfold Claims.own_genes, Claims.cycles. cbn [fold_right]. destruct c; try lia. all: destruct (_ =? r); lia. Qed.

Lemma run_grows commands : forall w, invariant l w -> Claims.lives_on r commands ->
  grows (robots w r) (robots (fold_left (fun w c => fst (do l w c)) commands w) r)
        (Claims.own_genes r commands) (Claims.cycles r commands).
Proof.
  induction commands as [|c commands IH]; intros w I Alive; [apply unchanged|].
  assert (Step : grows (robots w r) (robots (fst (do l w c)) r)
                   (Claims.own_genes r [c]) (Claims.cycles r [c])).
  { apply step_grows; auto. intros anew ->. apply (Alive anew). now left. }
  assert (Rest : Claims.lives_on r commands) by (intros anew J; apply (Alive anew); now right).
  specialize (IH _ (step_invariant l w c I) Rest). rewrite cons_own, cons_cycles. cbn [fold_left].
  intros g G L. destruct (Step g G L) as (g1 & G1 & L1 & A1 & B1 & C1).
  destruct (IH g1 G1 L1) as (g2 & G2 & L2 & A2 & B2 & C2).
  rewrite N.mul_add_distr_l. exists g2. repeat split; auto; [lia..|].
  intros Fits. assert (allowance g1 + per_cycle p * Claims.cycles r commands <= ceiling p) by lia.
  specialize (C2 H). lia.
Qed.

(** A whole life. *)
Lemma life_grows earlier block later : Claims.lives_on r later ->
  let (began, w) := Claims.life l earlier r block p later in
  exists g, guard (robots w r) = Some g
    /\ next (memory (robots w r)) + allowance g
       <= began + Claims.own_genes r later + Claims.earned p r later
    /\ (Claims.earned p r later <= ceiling p ->
        began + Claims.earned p r later <= next (memory (robots w r)) + allowance g).
Proof.
  intros Alive. unfold Claims.life, Claims.earned.
  set (begins := earlier ++ _). assert (I := run_invariant l Valid begins).
  assert (After : after_all l (begins ++ later)
            = fold_left (fun w c => fst (do l w c)) later (after_all l begins))
    by (unfold run; now rewrite fold_left_app).
  rewrite After. clear After. set (w := after_all l begins) in *.
  assert (G : guard (robots w r) = Some (opened p)).
  { subst w begins. rewrite run_snoc. cbn [step].
    rewrite resumes by apply (robots_ok l _ (run_invariant l Valid earlier)).
    cbn. now rewrite update_same. }
  destruct (run_grows later w I Alive (opened p) G eq_refl) as (g & G' & _ & A & _ & C).
  cbn [allowance opened] in *. exists g. repeat split; auto; [lia|].
  intros Fits. specialize (C Fits). lia.
Qed.
End Life.

Theorem allowance_bounds_clock : Claims.allowance_bounds_clock.
Proof.
  intros l earlier r block p later Valid Alive.
  assert (G := life_grows l Valid r p earlier block later Alive).
  destruct (Claims.life l earlier r block p later) as (began, w). destruct G as (g & _ & G & _). lia.
Qed.

(** What lies within reach of the sum is paid for. *)
Lemma paid l r c g stamp gs : stamp <= next c + allowance g ->
  pass l r c g stamp gs <> inr BeyondAllowance.
Proof.
  intros R. unfold pass, accept, beyond. destruct (existsb _ gs); [discriminate|].
  destruct (observe l c stamp) as [c'|] eqn:O.
  - apply observe_is_maximum in O. destruct (N.ltb_spec (allowance g) (next c' - next c)); [lia|].
    discriminate.
  - destruct (maximum l <? stamp); discriminate.
Qed.

Theorem allowance_admits_below : Claims.allowance_admits_below.
Proof.
  intros l earlier r block p later m Valid Alive Fits.
  assert (G := life_grows l Valid r p earlier block later Alive).
  destruct (Claims.life l earlier r block p later) as (began, w). destruct G as (g & G & _ & Line).
  intros Below. specialize (Line Fits). cbn [step]. unfold hear, learn. rewrite G.
  destruct (credible _ m); [|discriminate]. cbn [gated gene_clocks].
  assert (P := paid (own_limits l (robots w r)) r (memory (robots w r)) g (stamp m) (genes m)).
  destruct (pass _ r _ g _ _) as [[c g']|why]; [discriminate|]. cbn. intros E. apply P; [lia|].
  congruence.
Qed.

Theorem gate_never_refuses_honest : Claims.gate_never_refuses_honest.
Proof.
  intros l earlier r block p later k Valid Alive Honest Fits.
  assert (G := life_grows l Valid r p earlier block later Alive). unfold Claims.life in *.
  cbv beta iota in *. rewrite <- app_assoc in *. set (all := earlier ++ _ ++ later) in *.
  destruct G as (g & G & _ & Line). intros Window Below K.
  assert (Honest' : Claims.honest all).
  { intros r' m J. unfold all in J. apply in_app_or in J as [J|[J|J]];
      [apply (Honest r' m), in_or_app; now left | discriminate
      | apply (Honest r' m), in_or_app; now right]. }
  rewrite (stamp_alone_decides l all r k Valid Honest').
  assert (I := run_invariant l Valid all). destruct (run_within l all Valid) as (_ & M).
  set (w := after_all l all) in *. cbn [step].
  destruct (nth_error (network w) k) as [m|] eqn:H;
    [|apply nth_error_Some in K; contradiction].
  destruct (sent_properly l w k m I H) as (_ & Top). specialize (M m (nth_error_In _ _ H)).
  specialize (Line Fits). destruct (robots_ok l w I r) as (X & _).
  unfold hear, learn. rewrite G. cbn [credible gated gene_clocks genes stamp forallb].
  assert (P := paid (own_limits l (robots w r)) r (memory (robots w r)) g (stamp m) []).
  unfold pass, accept in *. cbn [existsb] in *.
  destruct (observe _ (memory (robots w r)) (stamp m)) as [c|] eqn:O.
  - destruct (allowance g <? _); [destruct P; [lia | reflexivity] | reflexivity].
  - apply observe_none in O. cbn in O. lia.
Qed.

Theorem conflict_is_refused : Claims.conflict_is_refused.
Proof.
  intros l commands r m gene w Gated Low J Mine New. cbn [step]. unfold hear, learn.
  cbn [credible gated gene_clocks].
  replace (forallb _ (genes m)) with true.
  2:{ symmetry. apply forallb_forall. intros other O. now apply N.ltb_lt, Low. }
  destruct (guard (robots w r)) as [g|]; [|contradiction]. unfold pass.
  replace (existsb _ (genes m)) with true; [reflexivity|].
  symmetry. apply existsb_exists. exists gene. split; auto. unfold unmade.
  apply andb_true_intro. split; [now apply N.eqb_eq | now apply N.leb_le].
Qed.

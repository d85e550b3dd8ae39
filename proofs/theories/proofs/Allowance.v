(** The sum of clock and allowance: receptions leave it, own genes and time raise it. *)
From Coq Require Import NArith List Lia.
From GeneClocks Require Import Clock Admission.
From GeneClocks Require Claims.
Import ListNotations.
Open Scope N_scope.

Local Opaque N.add N.sub N.mul N.min N.max.

Definition sum (g : guarded) : N := next (clock_of g) + allowance g.

Lemma reserve_next l c : next (reserve l c) = next c.
Proof. unfold reserve. destruct (durable c <? next c); reflexivity. Qed.

Lemma observe_next l c stamp c' : observe l c stamp = Some c' -> next c' = N.max (next c) stamp.
Proof.
  unfold observe. destruct (maximum l <? stamp); [discriminate|].
  destruct (N.ltb_spec (next c) stamp) as [H | H].
  - destruct (window l <? stamp - next c); [discriminate|]. intros [= <-].
    rewrite reserve_next. cbn. lia.
  - intros [= <-]. lia.
Qed.

Lemma accept_some l g stamp g' : accept l g stamp = Some g' -> sum g' = sum g.
Proof.
  unfold accept, sum. destruct (observe l (clock_of g) stamp) as [c|] eqn:O; [|discriminate].
  apply observe_next in O.
  destruct (N.ltb_spec (allowance g) (next c - next (clock_of g))) as [H | H]; [discriminate|].
  intros [= <-]. cbn. lia.
Qed.

Lemma react_sum l p g e :
  match e with
  | Makes count => sum g <= sum (react l p g e) <= sum g + count
  | Elapses => sum (react l p g e) = next (clock_of g) + N.min (allowance g + per_cycle p) (ceiling p)
  | Hears _ => sum (react l p g e) = sum g
  end.
Proof.
  destruct e; cbn.
  - unfold mint. destruct (maximum l - next (clock_of g) <? count); unfold sum; cbn; [lia|].
    rewrite reserve_next. cbn. lia.
  - reflexivity.
  - destruct (accept l g stamp) eqn:A; [exact (accept_some _ _ _ _ A) | reflexivity].
Qed.

Lemma sum_at_most l p events : forall g,
  sum (fold_left (react l p) events g) <= sum g + own_genes events + per_cycle p * cycles events.
Proof.
  induction events as [|e events IH]; intros g; cbn; [lia|].
  specialize (IH (react l p g e)). assert (S := react_sum l p g e).
  destruct e; cbn in *; unfold sum in *; lia.
Qed.

Theorem allowance_bounds_clock : Claims.allowance_bounds_clock.
Proof.
  intros l p c events. assert (S := sum_at_most l p events (guard p c)).
  unfold earned, live, sum in *. cbn in *. lia.
Qed.

(** Nothing is lost to the ceiling as long as all that was ever earned fits under it. *)
Lemma allowance_at_most l p events : forall g,
  allowance (fold_left (react l p) events g) <= allowance g + per_cycle p * cycles events.
Proof.
  induction events as [|e events IH]; intros g; cbn; [lia|].
  specialize (IH (react l p g e)). destruct e; cbn in *.
  - destruct (mint l (clock_of g) count) as [[? ?]|]; cbn in *; lia.
  - unfold earn in *. lia.
  - unfold accept in *. destruct (observe l (clock_of g) stamp); [|lia].
    destruct (allowance g <? next c - next (clock_of g)); cbn in *; lia.
Qed.

Lemma sum_at_least l p events : forall g,
  allowance g + per_cycle p * cycles events <= ceiling p ->
  sum g + per_cycle p * cycles events <= sum (fold_left (react l p) events g).
Proof.
  induction events as [|e events IH]; intros g Fits; cbn in *; [lia|].
  specialize (IH (react l p g e)). assert (S := react_sum l p g e).
  assert (A := allowance_at_most l p [e] g).
  destruct e; cbn in *; unfold sum, earn in *; cbn in *; lia.
Qed.

Theorem allowance_admits_below : Claims.allowance_admits_below.
Proof.
  intros l p c events stamp Fits Below g Seen.
  assert (S : sum (guard p c) + per_cycle p * cycles events <= sum g)
    by exact (sum_at_least l p events (guard p c) Fits).
  clearbody g. unfold accept, earned, sum in *. cbn in S.
  destruct (observe l (clock_of g) stamp) as [c'|] eqn:O; [|contradiction].
  apply observe_next in O.
  destruct (N.ltb_spec (allowance g) (next c' - next (clock_of g))); [lia | discriminate].
Qed.

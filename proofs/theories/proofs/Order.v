(** Marks: a strict total order with one sorted form per set. *)
From Coq Require Import NArith List Lia Sorting.Sorted Sorting.Permutation.
From GeneClocks Require Import Mark.
From GeneClocks Require Claims.
Import ListNotations.
Open Scope N_scope.

Lemma mark_compare_eq a b : mark_compare a b = Eq <-> a = b.
Proof.
  destruct a as [c r], b as [c' r']; unfold mark_compare; cbn.
  destruct (N.compare_spec c c'); subst.
  - rewrite N.compare_eq_iff. split; [intros -> | intros [= ->]]; reflexivity.
  - split; [discriminate | intros [= -> ->]; lia].
  - split; [discriminate | intros [= -> ->]; lia].
Qed.

Lemma mark_compare_antisym a b : mark_compare b a = CompOpp (mark_compare a b).
Proof.
  unfold mark_compare. rewrite (N.compare_antisym (counter a) (counter b)).
  destruct (counter a ?= counter b); cbn; auto. apply N.compare_antisym.
Qed.

Lemma mark_compare_gt a b : mark_compare a b = Gt <-> b << a.
Proof.
  unfold mark_lt. rewrite (mark_compare_antisym a b).
  destruct (mark_compare a b); cbn; split; congruence.
Qed.

Lemma mark_lt_iff a b :
  a << b <-> counter a < counter b \/ (counter a = counter b /\ maker a < maker b).
Proof.
  unfold mark_lt, mark_compare. destruct (N.compare_spec (counter a) (counter b)).
  - rewrite N.compare_lt_iff. lia.
  - split; auto.
  - split; [discriminate | lia].
Qed.

Lemma mark_eqb_eq a b : mark_eqb a b = true <-> a = b.
Proof.
  unfold mark_eqb. rewrite <- mark_compare_eq. destruct (mark_compare a b); split; congruence.
Qed.

Lemma mark_lt_irreflexive a : ~ a << a.
Proof. rewrite mark_lt_iff. lia. Qed.

Lemma mark_lt_transitive a b c : a << b -> b << c -> a << c.
Proof. rewrite !mark_lt_iff. lia. Qed.

Lemma mark_lt_asymmetric a b : a << b -> ~ b << a.
Proof. rewrite !mark_lt_iff. lia. Qed.

Lemma mark_lt_total a b : a << b \/ a = b \/ b << a.
Proof.
  destruct (mark_compare a b) eqn:E.
  - right. left. now apply mark_compare_eq.
  - left. exact E.
  - right. right. now apply mark_compare_gt.
Qed.

Lemma counter_decides a b : counter a < counter b -> a << b.
Proof. rewrite mark_lt_iff. auto. Qed.

Theorem lt_strict_total : Claims.lt_strict_total.
Proof.
  split; [exact mark_lt_irreflexive|]. split; [exact mark_lt_transitive|].
  split; [exact mark_lt_total | exact counter_decides].
Qed.

Lemma sorted_cons_iff a l : sorted (a :: l) <-> sorted l /\ forall b, In b l -> a << b.
Proof.
  split.
  - intros S. inversion_clear S as [|? ? S' F]. rewrite Forall_forall in F. auto.
  - intros [S F]. constructor; [|rewrite Forall_forall]; auto.
Qed.

Lemma sorted_nodup l : sorted l -> NoDup l.
Proof.
  induction l as [|a l IH]; intros S; constructor; apply sorted_cons_iff in S as [S F]; auto.
  intros I. exact (mark_lt_irreflexive _ (F _ I)).
Qed.

Lemma sorted_app l m :
  sorted (l ++ m) <-> sorted l /\ sorted m /\ forall a b, In a l -> In b m -> a << b.
Proof.
  induction l as [|x l IH]; cbn [app].
  - split; [intros S; repeat split; auto; [constructor | intros ? ? []] | tauto].
  - rewrite !sorted_cons_iff, IH. setoid_rewrite in_app_iff. cbn [In]. firstorder; subst; auto.
Qed.

Theorem sorted_form_unique : Claims.sorted_form_unique.
Proof.
  intros ours. induction ours as [|a ours IH]; intros [|b theirs] S1 S2 Same.
  - reflexivity.
  - destruct (proj2 (Same b)). now left.
  - destruct (proj1 (Same a)). now left.
  - apply sorted_cons_iff in S1 as [S1 F1], S2 as [S2 F2].
    assert (a = b) as <-.
    { destruct (proj1 (Same a) (or_introl eq_refl)) as [|A]; auto.
      destruct (proj2 (Same b) (or_introl eq_refl)) as [|B]; auto.
      destruct (mark_lt_asymmetric _ _ (F1 _ B) (F2 _ A)). }
    f_equal. apply IH; auto. intros m. split; intros I.
    + destruct (proj1 (Same m) (or_intror I)) as [<-|]; auto.
      destruct (mark_lt_irreflexive _ (F1 _ I)).
    + destruct (proj2 (Same m) (or_intror I)) as [<-|]; auto.
      destruct (mark_lt_irreflexive _ (F2 _ I)).
Qed.

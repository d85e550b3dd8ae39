(** Alignment: the merge agrees with what its words mean. *)
From Coq Require Import NArith List Lia Sorting.Sorted.
From GeneClocks Require Import Mark Alignment.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order.
Import ListNotations.

Section Merge.
Context {gene : Type} (mark_of : gene -> mark).
Implicit Types (a b : gene) (first second : list gene) (c : aligned gene).

Lemma align_nil_first second : align mark_of [] second = map (Excess Second) second.
Proof. now destruct second. Qed.

Lemma align_nil_second first : align mark_of first [] = map (Excess First) first.
Proof. now destruct first. Qed.

Lemma align_cons a first b second :
  align mark_of (a :: first) (b :: second) =
  match mark_compare (mark_of a) (mark_of b) with
  | Eq => Matching a b :: align mark_of first second
  | Lt => Disjoint First a :: align mark_of first (b :: second)
  | Gt => Disjoint Second b :: align mark_of (a :: first) second
  end.
Proof. reflexivity. Qed.

(** Induction along the merge. *)
Lemma merge_induction (P : list gene -> list gene -> Prop) :
  (forall second, P [] second) -> (forall first, P first []) ->
  (forall a first b second, mark_of a = mark_of b -> P first second ->
     P (a :: first) (b :: second)) ->
  (forall a first b second, mark_of a << mark_of b -> P first (b :: second) ->
     P (a :: first) (b :: second)) ->
  (forall a first b second, mark_of b << mark_of a -> P (a :: first) second ->
     P (a :: first) (b :: second)) ->
  forall first second, P first second.
Proof.
  intros Nil1 Nil2 Equal Less Greater.
  induction first as [|a first IH]; [apply Nil1|].
  induction second as [|b second IH']; [apply Nil2|].
  destruct (mark_lt_total (mark_of a) (mark_of b)) as [|[|]]; auto.
Qed.

Lemma align_eq a first b second : mark_of a = mark_of b ->
  align mark_of (a :: first) (b :: second) = Matching a b :: align mark_of first second.
Proof. intros E. rewrite align_cons. apply mark_compare_eq in E. now rewrite E. Qed.

Lemma align_less a first b second : mark_of a << mark_of b ->
  align mark_of (a :: first) (b :: second) = Disjoint First a :: align mark_of first (b :: second).
Proof. intros E. rewrite align_cons. now rewrite E. Qed.

Lemma align_greater a first b second : mark_of b << mark_of a ->
  align mark_of (a :: first) (b :: second)
  = Disjoint Second b :: align mark_of (a :: first) second.
Proof. intros E. rewrite align_cons. apply mark_compare_gt in E. now rewrite E. Qed.

Lemma symmetric first second :
  align mark_of second first = map mirror (align mark_of first second).
Proof.
  revert first second. apply merge_induction; intros.
  - rewrite align_nil_first, align_nil_second, map_map. reflexivity.
  - rewrite align_nil_first, align_nil_second, map_map. reflexivity.
  - rewrite !align_eq by congruence. cbn. now f_equal.
  - rewrite align_greater, align_less by assumption. cbn. now f_equal.
  - rewrite align_less, align_greater by assumption. cbn. now f_equal.
Qed.

Lemma project_all s (wrap : gene -> aligned gene) (l : list gene) :
  (forall a, genes_of s (wrap a) = [a]) -> flat_map (genes_of s) (map wrap l) = l.
Proof. intros H. induction l; cbn; rewrite ?H; cbn; congruence. Qed.

Lemma project_none s (wrap : gene -> aligned gene) (l : list gene) :
  (forall a, genes_of s (wrap a) = []) -> flat_map (genes_of s) (map wrap l) = [].
Proof. intros H. induction l; cbn; rewrite ?H; cbn; congruence. Qed.

Lemma partition first second :
  flat_map (genes_of First) (align mark_of first second) = first
  /\ flat_map (genes_of Second) (align mark_of first second) = second.
Proof.
  revert first second. apply merge_induction.
  - intros. rewrite align_nil_first. split; [apply project_none | apply project_all]; reflexivity.
  - intros. rewrite align_nil_second. split; [apply project_all | apply project_none]; reflexivity.
  - intros a first b second E [IH1 IH2]. rewrite align_eq by assumption.
    cbn [flat_map genes_of app]. now rewrite IH1, IH2.
  - intros a first b second E [IH1 IH2]. rewrite align_less by assumption.
    cbn [flat_map genes_of app]. now rewrite IH1, IH2.
  - intros a first b second E [IH1 IH2]. rewrite align_greater by assumption.
    cbn [flat_map genes_of app]. now rewrite IH1, IH2.
Qed.

Lemma in_own s first second a :
  In a (own s first second) <-> exists c, In c (align mark_of first second) /\ In a (genes_of s c).
Proof.
  destruct (partition first second) as [P1 P2].
  destruct s; cbn [own]; [rewrite <- P1 at 1 | rewrite <- P2 at 1]; apply in_flat_map.
Qed.

Notation marks := (map mark_of).

Lemma above_all l m : (forall y, In y l -> m << mark_of y) -> ~ has_mark mark_of l m.
Proof.
  intros L I. apply in_map_iff in I as (y & <- & I). exact (mark_lt_irreflexive _ (L y I)).
Qed.

Lemma sound first second : sorted (marks first) -> sorted (marks second) ->
  forall c, In c (align mark_of first second) -> classified mark_of first second c.
Proof.
  revert first second. apply (merge_induction (fun first second =>
    sorted (marks first) -> sorted (marks second) -> forall c,
    In c (align mark_of first second) -> classified mark_of first second c)).
  - intros second _ _ c I. rewrite align_nil_first in I. apply in_map_iff in I as (b & <- & I).
    cbn. unfold has_mark. cbn. firstorder.
  - intros first _ _ c I. rewrite align_nil_second in I. apply in_map_iff in I as (a & <- & I).
    cbn. unfold has_mark. cbn. firstorder.
  - intros a first b second E IH S1 S2 c I. rewrite align_eq in I by assumption.
    apply sorted_cons_iff in S1 as [S1 F1], S2 as [S2 F2].
    destruct I as [<-|I]; [cbn; auto|]. specialize (IH S1 S2 c I).
    assert (New : forall x, In x first -> mark_of x <> mark_of b).
    { intros x X Y. apply (in_map mark_of) in X. rewrite Y, <- E in X.
      exact (mark_lt_irreflexive _ (F1 _ X)). }
    assert (New' : forall y, In y second -> mark_of y <> mark_of a).
    { intros y X Y. apply (in_map mark_of) in X. rewrite Y, E in X.
      exact (mark_lt_irreflexive _ (F2 _ X)). }
    destruct c as [x y|[] x|[] x]; cbn in *; unfold has_mark in *; cbn [map In] in *.
    + tauto.
    + destruct IH as (X & Y & z & Z & L). repeat split; auto.
      * intros [|]; auto. exact (New _ X (eq_sym H)).
      * exists z. auto.
    + destruct IH as (X & Y & z & Z & L). repeat split; auto.
      * intros [|]; auto. exact (New' _ X (eq_sym H)).
      * exists z. auto.
    + destruct IH as (X & Y & L). repeat split; auto.
      * intros [|]; auto. exact (New _ X (eq_sym H)).
      * intros z [<-|]; auto. rewrite <- E. apply F1, in_map, X.
    + destruct IH as (X & Y & L). repeat split; auto.
      * intros [|]; auto. exact (New' _ X (eq_sym H)).
      * intros z [<-|]; auto. rewrite E. apply F2, in_map, X.
  - intros a first b second E IH S1 S2 c I. rewrite align_less in I by assumption.
    assert (S2' := S2).
    apply sorted_cons_iff in S1 as [S1 F1], S2' as [S2' F2].
    assert (New : forall y, In y (b :: second) -> mark_of a << mark_of y).
    { intros y [<-|Y]; auto. eapply mark_lt_transitive; [exact E | apply F2, in_map, Y]. }
    destruct I as [<-|I].
    { cbn [classified own other opposite]. split; [now left|]. split; [now apply above_all|].
      exists b. split; [now left | exact E]. }
    specialize (IH S1 S2 c I).
    destruct c as [x y|[] x|[] x]; cbn [classified own other opposite] in *.
    + firstorder.
    + firstorder.
    + destruct IH as (X & Y & z & Z & L). split; [exact X|]. split.
      * unfold has_mark in *. cbn [map In]. intros [H|]; auto. specialize (New x X).
        rewrite H in New. exact (mark_lt_irreflexive _ New).
      * exists z. split; auto. now right.
    + firstorder.
    + destruct IH as (X & Y & L). split; [exact X|]. split.
      * unfold has_mark in *. cbn [map In]. intros [H|]; auto. specialize (New x X).
        rewrite H in New. exact (mark_lt_irreflexive _ New).
      * intros z [<-|]; auto.
  - intros a first b second E IH S1 S2 c I. rewrite align_greater in I by assumption.
    assert (S1' := S1).
    apply sorted_cons_iff in S1' as [S1' F1], S2 as [S2 F2].
    assert (New : forall x, In x (a :: first) -> mark_of b << mark_of x).
    { intros x [<-|X]; auto. eapply mark_lt_transitive; [exact E | apply F1, in_map, X]. }
    destruct I as [<-|I].
    { cbn [classified own other opposite]. split; [now left|]. split; [now apply above_all|].
      exists a. split; [now left | exact E]. }
    specialize (IH S1 S2 c I).
    destruct c as [x y|[] x|[] x]; cbn [classified own other opposite] in *.
    + firstorder.
    + destruct IH as (X & Y & z & Z & L). split; [exact X|]. split.
      * unfold has_mark in *. cbn [map In]. intros [H|]; auto. specialize (New x X).
        rewrite H in New. exact (mark_lt_irreflexive _ New).
      * exists z. split; auto. now right.
    + firstorder.
    + destruct IH as (X & Y & L). split; [exact X|]. split.
      * unfold has_mark in *. cbn [map In]. intros [H|]; auto. specialize (New x X).
        rewrite H in New. exact (mark_lt_irreflexive _ New).
      * intros z [<-|]; auto.
    + firstorder.
Qed.

Lemma same_mark_same_gene l a b : sorted (marks l) -> In a l -> In b l -> mark_of a = mark_of b ->
  a = b.
Proof.
  induction l as [|x l IH]; intros S A B E; [destruct A|]. apply sorted_cons_iff in S as [S F].
  destruct A as [<-|A], B as [<-|B]; auto.
  - apply (in_map mark_of) in B. rewrite <- E in B. destruct (mark_lt_irreflexive _ (F _ B)).
  - apply (in_map mark_of) in A. rewrite E in A. destruct (mark_lt_irreflexive _ (F _ A)).
Qed.

Lemma complete first second : sorted (marks first) -> sorted (marks second) ->
  forall c, classified mark_of first second c -> In c (align mark_of first second).
Proof.
  intros S1 S2 c C.
  (* The gene lands in some class, which is sound; all other classes contradict this one. *)
  assert (Somewhere : forall s a, In a (own s first second) -> exists c',
            In c' (align mark_of first second) /\ In a (genes_of s c')
            /\ classified mark_of first second c').
  { intros s a A. apply in_own in A as (c' & I & G). exists c'. auto using sound. }
  destruct c as [a b|s a|s a].
  - destruct C as (A & B & E). destruct (Somewhere First a A) as (c' & I & G & C').
    destruct c' as [x y|[] x|[] x]; cbn in G; try tauto; destruct G as [<-|[]].
    + destruct C' as (_ & Y & E'). replace b with y; auto.
      apply (same_mark_same_gene second); congruence.
    + destruct C' as (_ & No & _). destruct No. unfold has_mark. rewrite E. now apply in_map.
    + destruct C' as (_ & No & _). destruct No. unfold has_mark. rewrite E. now apply in_map.
  - destruct C as (A & No & b & B & L). destruct (Somewhere s a A) as (c' & I & G & C').
    destruct c' as [x y|s' x|s' x]; [destruct s | destruct s, s' ..]; cbn in G; try tauto;
      destruct G as [<-|[]]; auto; exfalso.
    + destruct C' as (_ & Y & E). apply No. unfold has_mark. rewrite E. now apply in_map.
    + destruct C' as (X & _ & E). apply No. unfold has_mark. rewrite <- E. now apply in_map.
    + destruct C' as (_ & _ & All). exact (mark_lt_asymmetric _ _ L (All b B)).
    + destruct C' as (_ & _ & All). exact (mark_lt_asymmetric _ _ L (All b B)).
  - destruct C as (A & No & All). destruct (Somewhere s a A) as (c' & I & G & C').
    destruct c' as [x y|s' x|s' x]; [destruct s | destruct s, s' ..]; cbn in G; try tauto;
      destruct G as [<-|[]]; auto; exfalso.
    + destruct C' as (_ & Y & E). apply No. unfold has_mark. rewrite E. now apply in_map.
    + destruct C' as (X & _ & E). apply No. unfold has_mark. rewrite <- E. now apply in_map.
    + destruct C' as (_ & _ & b & B & L). exact (mark_lt_asymmetric _ _ L (All b B)).
    + destruct C' as (_ & _ & b & B & L). exact (mark_lt_asymmetric _ _ L (All b B)).
Qed.

(** The output is in the order of marks: what is aligned later lies above. *)
Lemma aligned_mark_origin first second c : In c (align mark_of first second) ->
  In (aligned_mark mark_of c) (marks first) \/ In (aligned_mark mark_of c) (marks second).
Proof.
  intros I. assert (Own : forall s a, In a (genes_of s c) -> In a (own s first second)).
  { intros s a G. apply in_own. eauto. }
  destruct c as [a b|[] a|[] a]; cbn [aligned_mark].
  - left. apply in_map, (Own First). now left.
  - left. apply in_map, (Own First). now left.
  - right. apply in_map, (Own Second). now left.
  - left. apply in_map, (Own First). now left.
  - right. apply in_map, (Own Second). now left.
Qed.

Lemma in_order first second : sorted (marks first) -> sorted (marks second) ->
  sorted (map (aligned_mark mark_of) (align mark_of first second)).
Proof.
  revert first second. apply (merge_induction (fun first second =>
    sorted (marks first) -> sorted (marks second) ->
    sorted (map (aligned_mark mark_of) (align mark_of first second)))).
  - intros second _ S. now rewrite align_nil_first, map_map.
  - intros first S _. now rewrite align_nil_second, map_map.
  - intros a first b second E IH S1 S2. rewrite align_eq by assumption. cbn [map].
    apply sorted_cons_iff in S1 as [S1 F1], S2 as [S2 F2]. apply sorted_cons_iff. split; auto.
    intros m I. apply in_map_iff in I as (c & <- & I). cbn [aligned_mark].
    apply aligned_mark_origin in I as [I|I]; [now apply F1 | rewrite E; now apply F2].
  - intros a first b second E IH S1 S2. rewrite align_less by assumption. cbn [map].
    assert (S2' := S2). apply sorted_cons_iff in S1 as [S1 F1], S2' as [S2' F2].
    apply sorted_cons_iff. split; auto.
    intros m I. apply in_map_iff in I as (c & <- & I). cbn [aligned_mark].
    apply aligned_mark_origin in I as [I|[I|I]]; [now apply F1 | now rewrite <- I |].
    exact (mark_lt_transitive _ _ _ E (F2 _ I)).
  - intros a first b second E IH S1 S2. rewrite align_greater by assumption. cbn [map].
    assert (S1' := S1). apply sorted_cons_iff in S1' as [S1' F1], S2 as [S2 F2].
    apply sorted_cons_iff. split; auto.
    intros m I. apply in_map_iff in I as (c & <- & I). cbn [aligned_mark].
    apply aligned_mark_origin in I as [[I|I]|I]; [now rewrite <- I | | now apply F2].
    exact (mark_lt_transitive _ _ _ E (F1 _ I)).
Qed.
End Merge.

Theorem align_symmetric : Claims.align_symmetric.
Proof. intros gene mark_of a b. apply symmetric. Qed.

Theorem align_partition : Claims.align_partition.
Proof.
  intros gene mark_of a b. cbn. destruct (partition mark_of a b). auto using in_order.
Qed.

Theorem align_sound : Claims.align_sound.
Proof. intros gene mark_of a b c S1 S2. now apply sound. Qed.

Theorem align_complete : Claims.align_complete.
Proof. intros gene mark_of a b c S1 S2. now apply complete. Qed.

Theorem excess_one_side : Claims.excess_one_side.
Proof.
  intros gene mark_of a b s S1 S2. split; intros (x & X); exists x.
  - apply sound in X; auto. destruct X as (X & _ & L). auto.
  - destruct X as (X & L). apply complete; auto. cbn. repeat split; auto.
    unfold has_mark. rewrite in_map_iff. intros (y & E & Y). specialize (L y Y).
    rewrite E in L. exact (mark_lt_irreflexive _ L).
Qed.

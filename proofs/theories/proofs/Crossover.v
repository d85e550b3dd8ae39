(** Crossover and distance see a marking only through which genes match, and through the order
    within each parent. *)
From Coq Require Import NArith QArith List Bool Lia.
From GeneClocks Require Import Mark Alignment Genome.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order Merge.
Import ListNotations.

(** ** The child's marks are the fitter parent's *)

Definition selection {A} (l : list A) (which : list bool) : list A :=
  map fst (filter snd (combine l which)).

Lemma selection_in {A} (l : list A) which a : In a (selection l which) -> In a l.
Proof.
  unfold selection. rewrite in_map_iff. intros ((x, b) & <- & J). apply filter_In in J as [J _].
  now apply in_combine_l in J.
Qed.

Lemma selection_sorted l which : sorted l -> sorted (selection l which).
Proof.
  revert which. induction l as [|a l IH]; intros [|b which] S; try constructor.
  apply sorted_cons_iff in S as [S F]. destruct b; [|now apply IH].
  apply sorted_cons_iff. split; [now apply IH|]. intros m J. now apply F, (selection_in _ which).
Qed.

Lemma matching_marks {gene} (mark_of : gene -> mark) first second a b :
  In (Matching a b) (align mark_of first second) -> mark_of a = mark_of b.
Proof.
  revert first second. apply (merge_induction mark_of (fun first second =>
    In (Matching a b) (align mark_of first second) -> mark_of a = mark_of b)); intros *.
  - rewrite align_nil_first, in_map_iff. intros (x & [=] & _).
  - rewrite align_nil_second, in_map_iff. intros (x & [=] & _).
  - intros E IH. rewrite align_eq by assumption. intros [[= -> ->]|J]; auto.
  - intros E IH. rewrite align_less by assumption. intros [[=]|J]; auto.
  - intros E IH. rewrite align_greater by assumption. intros [[=]|J]; auto.
Qed.

Section Inherit.
Context {gene draws : Type} (mark_of : gene -> mark)
  (choose : draws -> gene -> gene -> gene * draws) (keep : list gene -> gene -> bool).

Lemma inherit_selects alignment :
  (forall a b d, In (Matching a b) alignment -> mark_of (fst (choose d a b)) = mark_of a) ->
  forall d child, exists which,
    map mark_of (fst (inherit choose keep d child alignment))
    = map mark_of child ++ selection (map mark_of (flat_map (genes_of First) alignment)) which.
Proof.
  induction alignment as [|c rest IH]; intros Choice d child.
  - exists []. cbn. now rewrite app_nil_r.
  - assert (Choice' := fun a b d J => Choice a b d (or_intror J)).
    assert (Joined : forall child chosen m d, mark_of chosen = m -> exists which,
              map mark_of (fst (inherit choose keep d (join keep child chosen) rest))
              = map mark_of child
                ++ selection (m :: map mark_of (flat_map (genes_of First) rest)) which).
    { intros child' chosen m d' <-. destruct (IH Choice' d' (join keep child' chosen)) as (which & ->).
      unfold join. destruct (keep child' chosen).
      - exists (true :: which). rewrite map_app, <- app_assoc. reflexivity.
      - exists (false :: which). reflexivity. }
    destruct c as [a b|[] a|[] a]; cbn [inherit flat_map genes_of app map]; auto.
    destruct (choose d a b) as (chosen, d') eqn:E. apply Joined.
    specialize (Choice a b d (or_introl eq_refl)). now rewrite E in Choice.
Qed.

Lemma inherit_keeps_all alignment :
  (forall a b d, In (Matching a b) alignment -> mark_of (fst (choose d a b)) = mark_of a) ->
  (forall child a, keep child a = true) -> forall d child,
    map mark_of (fst (inherit choose keep d child alignment))
    = map mark_of child ++ map mark_of (flat_map (genes_of First) alignment).
Proof.
  intros Choice Keep. induction alignment as [|c rest IH]; intros d child.
  - cbn. now rewrite app_nil_r.
  - assert (Choice' := fun a b d J => Choice a b d (or_intror J)).
    assert (Joined : forall child chosen m d, mark_of chosen = m ->
              map mark_of (fst (inherit choose keep d (join keep child chosen) rest))
              = map mark_of child ++ m :: map mark_of (flat_map (genes_of First) rest)).
    { intros child' chosen m d' <-. rewrite IH by assumption. unfold join. rewrite Keep, map_app.
      now rewrite <- app_assoc. }
    destruct c as [a b|[] a|[] a]; cbn [inherit flat_map genes_of app map]; auto.
    destruct (choose d a b) as (chosen, d') eqn:E. apply Joined.
    specialize (Choice a b d (or_introl eq_refl)). now rewrite E in Choice.
Qed.
End Inherit.

Theorem crossover_keeps_fitter_marks : Claims.crossover_keeps_fitter_marks.
Proof.
  intros gene draws mark_of choose keep d fitter weaker Choice child.
  assert (C : forall a b d, In (Matching a b) (align mark_of fitter weaker) ->
            mark_of (fst (choose d a b)) = mark_of a).
  { intros a b d' J. now apply Choice, (matching_marks mark_of fitter weaker). }
  destruct (partition mark_of fitter weaker) as (P & _). subst child. unfold crossover. split.
  - destruct (inherit_selects mark_of choose keep _ C d []) as (which & ->). rewrite P.
    now exists which.
  - intros Keep. rewrite (inherit_keeps_all mark_of choose keep _ C Keep). now rewrite P.
Qed.

Theorem odneat_keeps_fitter_marks : Claims.odneat_keeps_fitter_marks.
Proof.
  intros fitter weaker draws from_other. split; apply crossover_keeps_fitter_marks.
  - intros d a b _. unfold choose_uniformly. destruct (draw d) as ((? & ?), d').
    destruct (xorb _ _); [|reflexivity]. now destruct (draw d') as ((? & ?), ?).
  - intros d a b _. destruct d as [|[] d]; reflexivity.
Qed.

(** ** A normal form of the alignment that forgets the order between the parents *)

Section Pairing.
Context {gene : Type} (mark_of : gene -> mark).

Definition partner (second : list gene) (a : gene) : option gene :=
  find (fun b => mark_eqb (mark_of a) (mark_of b)) second.

Lemma partner_none second a :
  (forall b, In b second -> mark_of a <> mark_of b) -> partner second a = None.
Proof.
  intros H. unfold partner. destruct (find _ second) as [b|] eqn:F; auto.
  apply find_some in F as [J E]. apply mark_eqb_eq in E. destruct (H b J E).
Qed.

Lemma partner_skip b second a : mark_of a <> mark_of b ->
  partner (b :: second) a = partner second a.
Proof.
  intros H. unfold partner. cbn. destruct (mark_eqb _ _) eqn:E; auto.
  apply mark_eqb_eq in E. contradiction.
Qed.

Definition pairing (first second : list gene) : list (gene * option gene) :=
  map (fun a => (a, partner second a)) first.

Lemma pairing_skip b first second : (forall a, In a first -> mark_of a <> mark_of b) ->
  pairing first (b :: second) = pairing first second.
Proof.
  intros H. apply map_ext_in. intros a J. now rewrite partner_skip by auto.
Qed.

(** What a reading of the alignment that skips the second parent's own genes comes to. *)
Fixpoint skipping (alignment : list (aligned gene)) : list (gene * option gene) :=
  match alignment with
  | [] => []
  | Matching a b :: rest => (a, Some b) :: skipping rest
  | Disjoint First a :: rest | Excess First a :: rest => (a, None) :: skipping rest
  | Disjoint Second _ :: rest | Excess Second _ :: rest => skipping rest
  end.

Lemma above x l y : sorted (x :: map mark_of l) -> In y l -> x << mark_of y.
Proof. intros S J. apply sorted_cons_iff in S as [_ F]. now apply F, in_map. Qed.

Lemma above_differs m m' : m << m' -> m' <> m.
Proof. intros L ->. exact (mark_lt_irreflexive _ L). Qed.

Lemma skipping_align first second :
  sorted (map mark_of first) -> sorted (map mark_of second) ->
  skipping (align mark_of first second) = pairing first second.
Proof.
  revert first second. apply (merge_induction mark_of (fun first second =>
    sorted (map mark_of first) -> sorted (map mark_of second) ->
    skipping (align mark_of first second) = pairing first second)).
  - intros second _ _. rewrite align_nil_first. now induction second.
  - intros first _ _. rewrite align_nil_second. induction first as [|a first IH]; [reflexivity|].
    cbn [map skipping]. rewrite IH. reflexivity.
  - intros a first b second E IH S1 S2. rewrite align_eq by assumption.
    cbn [skipping pairing map]. fold (pairing first (b :: second)).
    rewrite pairing_skip, IH.
    + do 2 f_equal. unfold partner. cbn. now apply mark_eqb_eq in E as ->.
    + now apply sorted_cons_iff in S1.
    + now apply sorted_cons_iff in S2.
    + intros x J. rewrite <- E. apply above_differs. now apply above with first.
  - intros a first b second E IH S1 S2. rewrite align_less by assumption.
    cbn [skipping pairing map]. fold (pairing first (b :: second)).
    rewrite IH; auto; [|now apply sorted_cons_iff in S1]. rewrite partner_none; auto.
    intros y [<-|J] H; rewrite H in E.
    + exact (mark_lt_irreflexive _ E).
    + exact (mark_lt_asymmetric _ _ E (above _ _ _ S2 J)).
  - intros a first b second E IH S1 S2. rewrite align_greater by assumption.
    cbn [skipping]. rewrite pairing_skip, IH; auto; [now apply sorted_cons_iff in S2|].
    intros x [<-|J]; apply above_differs; auto.
    eapply mark_lt_transitive; [exact E | now apply above with first].
Qed.

Lemma matches_skipping alignment : matches alignment
  = flat_map (fun p => match snd p with Some b => [(fst p, b)] | None => [] end)
             (skipping alignment).
Proof. induction alignment as [|[a b|[] a|[] a] rest IH]; cbn; auto. now f_equal. Qed.

Lemma inherit_skipping {draws} (choose : draws -> gene -> gene -> gene * draws) keep one two :
  skipping one = skipping two ->
  forall d child, inherit choose keep d child one = inherit choose keep d child two.
Proof.
  (* both are the same reading of the normal form *)
  pose (read := fix read d child (l : list (gene * option gene)) {struct l} :=
    match l with
    | [] => (child, d)
    | (a, Some b) :: rest =>
        let (chosen, d) := choose d a b in read d (join keep child chosen) rest
    | (a, None) :: rest => read d (join keep child a) rest
    end).
  assert (R : forall alignment d child,
            inherit choose keep d child alignment = read d child (skipping alignment)).
  { induction alignment as [|[a b|[] a|[] a] rest IH]; intros d child; cbn; auto.
    destruct (choose d a b). apply IH. }
  intros E d child. rewrite !R. now rewrite E.
Qed.
End Pairing.

(** Two ways to mark the genes of two parents that agree on what matches and on each parent's
    own order. *)
Section Two.
Context {gene : Type} (one two : gene -> mark) (a b : list gene)
  (Sa1 : sorted (map one a)) (Sb1 : sorted (map one b))
  (Sa2 : sorted (map two a)) (Sb2 : sorted (map two b))
  (Agree : forall x y, In x a -> In y b -> one x = one y <-> two x = two y).

Lemma same_pairing : pairing one a b = pairing two a b.
Proof.
  apply map_ext_in. intros x X. f_equal. unfold partner.
  assert (H : forall l, (forall y, In y l -> In y b) ->
            find (fun y => mark_eqb (one x) (one y)) l = find (fun y => mark_eqb (two x) (two y)) l).
  { induction l as [|y l IH]; intros Sub; auto. cbn.
    replace (mark_eqb (two x) (two y)) with (mark_eqb (one x) (one y)).
    - rewrite IH; auto with datatypes.
    - apply eq_true_iff_eq. rewrite !mark_eqb_eq. apply Agree; auto with datatypes. }
  now apply H.
Qed.

Lemma same_skipping : skipping (align one a b) = skipping (align two a b).
Proof. rewrite !skipping_align by assumption. exact same_pairing. Qed.

Lemma same_crossover {draws} (choose : draws -> gene -> gene -> gene * draws) keep d :
  crossover one choose keep d a b = crossover two choose keep d a b.
Proof. apply inherit_skipping, same_skipping. Qed.

Lemma same_matches : matches (align one a b) = matches (align two a b).
Proof. now rewrite !matches_skipping, same_skipping. Qed.

Lemma unmatched (mark_of : gene -> mark) s x :
  sorted (map mark_of a) -> sorted (map mark_of b) ->
  In (Disjoint s x) (align mark_of a b) \/ In (Excess s x) (align mark_of a b)
  <-> In x (own s a b) /\ ~ has_mark mark_of (other s a b) (mark_of x).
Proof.
  intros Sa Sb. split.
  - intros [J|J]; apply (sound mark_of a b Sa Sb) in J; cbn in J; tauto.
  - intros (X & No). apply in_own with (mark_of := mark_of) in X as (c & J & G).
    assert (C := sound mark_of a b Sa Sb c J).
    destruct c as [y z|s' y|s' y]; [destruct s | destruct s, s' ..]; cbn in G; try tauto;
      destruct G as [<-|[]]; auto; destruct C as (Y & Z & E); exfalso; apply No; unfold has_mark.
    + rewrite E. now apply in_map.
    + rewrite <- E. now apply in_map.
Qed.

Lemma same_unmatched s x :
  In (Disjoint s x) (align one a b) \/ In (Excess s x) (align one a b)
  <-> In (Disjoint s x) (align two a b) \/ In (Excess s x) (align two a b).
Proof.
  rewrite !unmatched by assumption.
  assert (E : In x (own s a b) ->
            has_mark one (other s a b) (one x) <-> has_mark two (other s a b) (two x)).
  { intros X. unfold has_mark. rewrite !in_map_iff. destruct s; cbn in *;
      split; intros (y & Y & Z); exists y; (split; [|exact Z]).
    - now apply eq_sym, Agree, eq_sym in Y.
    - now apply eq_sym, Agree, eq_sym in Y.
    - now apply Agree in Y.
    - now apply Agree in Y. }
  tauto.
Qed.

Lemma counts (alignment : list (aligned gene)) :
  (length (flat_map (genes_of First) alignment) + length (flat_map (genes_of Second) alignment)
   = 2 * length (matches alignment) + (disjoint_count alignment + excess_count alignment))%nat.
Proof.
  unfold disjoint_count, excess_count, matches.
  induction alignment as [|[x y|[] x|[] x] rest IH]; cbn; lia.
Qed.

Lemma same_unmatched_count :
  (disjoint_count (align one a b) + excess_count (align one a b)
   = disjoint_count (align two a b) + excess_count (align two a b))%nat.
Proof.
  assert (C1 := counts (align one a b)). assert (C2 := counts (align two a b)).
  destruct (partition one a b) as (P1 & P2), (partition two a b) as (Q1 & Q2).
  rewrite P1, P2, same_matches in C1. rewrite Q1, Q2 in C2. lia.
Qed.

Lemma same_distance c1 c2 c3 size difference : (c1 == c2)%Q ->
  (distance one c1 c2 c3 size difference a b == distance two c1 c2 c3 size difference a b)%Q.
Proof.
  intros E. unfold distance. rewrite same_matches, E.
  assert (Sum : forall d e : nat,
    (c2 * (Z.of_nat e # size) + c2 * (Z.of_nat d # size) == c2 * (Z.of_nat (d + e) # size))%Q).
  { intros d e. rewrite <- Qmult_plus_distr_r, Qplus_comm.
    apply Qmult_comp; [reflexivity|]. unfold Qeq, Qplus; cbn.
    rewrite Nat2Z.inj_add, Pos2Z.inj_mul. ring. }
  rewrite !Sum, same_unmatched_count. reflexivity.
Qed.
End Two.

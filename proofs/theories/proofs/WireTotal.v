(** Every well-formed message within the limits has an encoding. *)
From Coq Require Import NArith PeanoNat List Bool Lia Sorting.Sorted.
From GeneClocks Require Import Mark Wire.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order.
Import ListNotations.
Open Scope N_scope.

Lemma neurons_cons g genes : neurons (g :: genes) = (if is_neuron g then 1 else 0) + neurons genes.
Proof. unfold neurons. cbn [filter]. destruct (is_neuron g); cbn [length]; lia. Qed.

(** ** The checks pass *)

Section Checks.
Context (l : limits) (stamp : N).

Definition mark_ok (g : gene) : Prop := let m := mark_of g in
  1 <= counter m < stamp /\ (maker m = 0 <-> counter m <= genesis_count l).

(** Each mark is above the one before it, the first above [last]. *)
Fixpoint ascending (last : mark) (genes : list gene) : Prop :=
  match genes with
  | [] => True
  | g :: others => last << mark_of g /\ ascending (mark_of g) others
  end.

Lemma sorted_ascending genes : forall last, sorted (map mark_of genes) ->
  (forall g, In g genes -> last << mark_of g) -> ascending last genes.
Proof.
  induction genes as [|g genes IH]; intros last S Below; cbn; auto.
  apply sorted_cons_iff in S as (S & Above). split; [apply Below; now left|].
  apply IH; auto. intros other J. apply Above. now apply in_map.
Qed.

Lemma mark_passes last g : last << mark_of g -> mark_ok g ->
  mark_admitted l stamp last (mark_of g) = true.
Proof.
  intros L ((A & B) & C). unfold mark_admitted. unfold mark_lt in L. rewrite L.
  replace (counter (mark_of g) <? stamp) with true by (symmetry; now apply N.ltb_lt).
  replace (1 <=? counter (mark_of g)) with true by (symmetry; now apply N.leb_le).
  cbn. destruct (N.eqb_spec (maker (mark_of g)) 0) as [E|E],
    (N.leb_spec (counter (mark_of g)) (genesis_count l)) as [F|F]; cbn; auto; exfalso.
  - apply C in E. lia.
  - apply C in F. contradiction.
Qed.

(** Hidden neurons and connections, after the initial neurons; [first] may be a target first. *)
Lemma later_passes first later : forall last kinds joined,
  ascending last later -> Forall mark_ok later -> Forall (weight_within l) later ->
  Forall (fun g => body_of g = Neuron Hidden \/ is_connection g) later ->
  NoDup (joined ++ flat_map ends_of later) ->
  existsb is_output kinds = true ->
  (exists k others, kinds = k :: others /\ (k = Output \/ k = Hidden)) ->
  (forall t, first <= N.of_nat t -> (t < length kinds)%nat ->
     may_be_target (nth t (rev kinds) Input) = true) ->
  (forall before g after source target, later = before ++ g :: after ->
     ends_of g = [(source, target)] ->
     let known := N.of_nat (length kinds) + neurons before in
     source < known /\ first <= target < known) ->
  admitted l stamp last kinds joined later = true.
Proof.
  induction later as [|g later IH]; intros last kinds joined Asc Marks Weights Kinds Once Out Head
    Targets Joins; cbn [admitted]; auto.
  destruct Asc as (Above & Asc). inversion_clear Marks. inversion_clear Weights. inversion_clear Kinds.
  rewrite mark_passes by assumption. cbn [andb].
  destruct H3 as [Hidden_|(on & rec & s & t & w & Joined)].
  - rewrite Hidden_. cbn [is_hidden orb andb]. destruct Head as (k & others & -> & K).
    replace (may_follow Hidden (k :: others)) with true by (now destruct K as [-> | ->]).
    cbn [andb]. apply IH; auto.
    + unfold ends_of in Once. cbn [flat_map] in Once. now rewrite Hidden_ in Once.
    + exists Hidden, (k :: others). auto.
    + intros i F I. change (rev (Hidden :: k :: others)) with (rev (k :: others) ++ [Hidden]).
      destruct (Nat.lt_ge_cases i (length (k :: others))) as [Lt|Ge].
      * rewrite app_nth1 by now rewrite rev_length. now apply Targets.
      * rewrite app_nth2 by now rewrite rev_length. rewrite rev_length.
        replace (i - length (k :: others))%nat with 0%nat; [reflexivity|]. cbn [length] in *. lia.
    + intros before c after source target E Ends known. subst later.
      destruct (Joins (g :: before) c after source target eq_refl Ends) as (A & B).
      rewrite neurons_cons in A, B. unfold is_neuron in A, B. rewrite Hidden_ in A, B.
      subst known. cbn [length] in *. lia.
  - rewrite Joined. cbn zeta. unfold ends_of in Once. cbn [flat_map] in Once. rewrite Joined in Once.
    destruct (Joins [] g later s t eq_refl) as (S & T); [unfold ends_of; now rewrite Joined|].
    unfold neurons in S, T. cbn [filter length N.of_nat] in S, T. rewrite N.add_0_r in S, T.
    rewrite Out. cbn [andb].
    replace (s <? _) with true by (symmetry; now apply N.ltb_lt).
    replace (t <? _) with true by (symmetry; now apply N.ltb_lt).
    cbn [andb]. rewrite Targets by (rewrite ?N2Nat.id; lia). cbn [andb].
    replace (existsb _ joined) with false.
    2:{ symmetry. apply not_true_iff_false. intros E. apply existsb_exists in E as ((s', t') & J & E).
        cbn in E. apply andb_prop in E as (E1 & E2). apply N.eqb_eq in E1, E2. subst.
        apply NoDup_remove_2 in Once. apply Once. apply in_or_app. now left. }
    cbn [negb andb]. match goal with W : weight_within l g |- _ =>
      unfold weight_within in W; rewrite Joined in W; rewrite W end. cbn [andb].
    apply IH; auto.
    + cbn [app]. apply NoDup_cons_iff. split.
      * now apply NoDup_remove_2 in Once.
      * now apply NoDup_remove_1 in Once.
    + intros before c after source target E Ends known. subst later.
      destruct (Joins (g :: before) c after source target eq_refl Ends) as (A & B).
      rewrite neurons_cons in A, B. unfold is_neuron in A, B. rewrite Joined in A, B.
      subst known. lia.
Qed.

Definition last_mark (last : mark) (genes : list gene) : mark :=
  fold_left (fun _ g => mark_of g) genes last.

(** Initial neurons of one kind. *)
Lemma run_passes k genes : forall last kinds rest,
  is_hidden k = false ->
  (forall others, may_follow k (k :: others) = true) \/ (length genes <= 1)%nat ->
  (genes = [] \/ may_follow k kinds = true) -> Forall (initial k) genes -> Forall mark_ok genes ->
  ascending last (genes ++ rest) ->
  admitted l stamp last kinds [] (genes ++ rest)
  = admitted l stamp (last_mark last genes) (repeat k (length genes) ++ kinds) [] rest
  /\ ascending (last_mark last genes) rest.
Proof.
  induction genes as [|g genes IH]; intros last kinds rest Shown Self First Same Marks Asc; [now split|].
  inversion_clear Same as [|? ? (Body & Maker) Same']. inversion_clear Marks as [|? ? Ok Marks'].
  destruct Asc as (Above & Asc). destruct First as [|First]; [discriminate|].
  assert (Self' : (forall others, may_follow k (k :: others) = true) \/ (length genes <= 1)%nat)
    by (destruct Self as [|Short]; [now left | right; cbn in Short; lia]).
  assert (Next : genes = [] \/ may_follow k (k :: kinds) = true).
  { destruct Self as [Self|Short]; [right; apply Self | left]. destruct genes; [auto | cbn in Short; lia]. }
  destruct (IH (mark_of g) (k :: kinds) rest Shown Self' Next Same' Marks' Asc) as (E & Asc').
  split; [|exact Asc']. cbn [app admitted]. rewrite mark_passes, Body, First, Shown by assumption.
  rewrite (proj2 (N.eqb_eq _ _) Maker). cbn [orb andb].
  rewrite E. cbn [length repeat app last_mark fold_left]. f_equal.
  change (k :: kinds) with ([k] ++ kinds). now rewrite app_assoc, <- repeat_cons.
Qed.

Lemma no_ends k genes : Forall (initial k) genes -> flat_map ends_of genes = [].
Proof.
  induction 1 as [|g genes (Body & _) _ IH]; [reflexivity|]. cbn. unfold ends_of at 1. now rewrite Body.
Qed.

Lemma well_formed_passes genes : well_formed l stamp genes ->
  admitted l stamp before_all [] [] genes = true.
Proof.
  intros [Order Below (inputs & bias & outputs & later & E & Inputs & Bias_ & Outputs & Some_ & Kinds & Joins)
          Once Weights].
  change (Forall mark_ok genes) in Below.
  assert (Asc : ascending before_all genes).
  { apply sorted_ascending; auto. intros g J. rewrite Forall_forall in Below.
    destruct (Below g J) as ((A & _) & _). apply counter_decides. cbn. lia. }
  subst genes. change (bias :: outputs ++ later) with ([bias] ++ (outputs ++ later)) in *.
  apply Forall_app in Below as (Ok1 & Below). apply Forall_app in Below as (Ok2 & Below).
  apply Forall_app in Below as (Ok3 & Ok4).
  assert (One : Forall (initial Bias) [bias]) by (constructor; auto).
  destruct (run_passes Input inputs before_all [] ([bias] ++ outputs ++ later))
    as (-> & Asc1); auto.
  rewrite app_nil_r. set (n := length inputs).
  assert (Follow : [bias] = [] \/ may_follow Bias (repeat Input n) = true)
    by (right; now destruct n).
  destruct (run_passes Bias [bias] (last_mark before_all inputs) (repeat Input n)
              (outputs ++ later)) as (-> & Asc2); auto.
  set (kinds := repeat Bias (length [bias]) ++ repeat Input n).
  destruct (run_passes Output outputs (last_mark (last_mark before_all inputs) [bias]) kinds later)
    as (-> & Asc3); auto.
  set (m := length outputs).
  assert (Length : length (repeat Output m ++ kinds) = (m + S n)%nat)
    by (unfold kinds; rewrite !app_length, !repeat_length; reflexivity).
  assert (Some_outputs : exists m', m = S m').
  { destruct outputs as [|o outputs']; [contradiction|]. now exists (length outputs'). }
  apply later_passes with (first := N.of_nat n + 1); auto.
  - apply Forall_app in Weights as (_ & W). apply Forall_app in W as (_ & W).
    now apply Forall_app in W as (_ & W).
  - rewrite !flat_map_app, (no_ends Input), (no_ends Bias), (no_ends Output) in Once by assumption.
    exact Once.
  - destruct Some_outputs as (m' & ->). reflexivity.
  - destruct Some_outputs as (m' & ->). exists Output, (repeat Output m' ++ kinds). auto.
  - intros t F T. rewrite Length in T. rewrite rev_nth by lia. rewrite Length.
    assert (In_ : In (nth (m + S n - S t) (repeat Output m) Input) (repeat Output m)).
    { apply nth_In. rewrite repeat_length. lia. }
    rewrite app_nth1 by (rewrite repeat_length; lia). apply repeat_spec in In_. now rewrite In_.
  - intros before g after source target E Ends known.
    destruct (Joins before g after source target E Ends) as (A & B).
    subst known. rewrite Length. fold n m in A, B. lia.
Qed.
End Checks.

(** ** The bytes fit *)

Lemma varint_size bytes : forall n, (length (put_varint bytes n) <= bytes)%nat.
Proof.
  induction bytes as [|bytes IH]; intros n; cbn; [lia|].
  destruct (n <? 128); cbn; [lia|]. specialize (IH (n / 128)). lia.
Qed.

Lemma number_size k : forall bytes n, n < 128 ^ N.of_nat (S k) ->
  (length (put_varint bytes n) <= S k)%nat.
Proof.
  induction k as [|k IH]; intros [|bytes] n L; cbn [put_varint length]; try lia.
  - destruct (N.ltb_spec n 128); cbn; [lia|]. cbn in L. lia.
  - destruct (N.ltb_spec n 128); cbn; [lia|].
    assert (n / 128 < 128 ^ N.of_nat (S k)).
    { apply N.div_lt_upper_bound; [lia|]. rewrite <- N.pow_succ_r'. now rewrite <- Nat2N.inj_succ. }
    specialize (IH bytes (n / 128) H0). lia.
Qed.

Lemma word_size bytes n : length (put_word bytes n) = bytes.
Proof. revert n. induction bytes as [|bytes IH]; intros n; cbn; auto. Qed.

Ltac measure := repeat (rewrite app_length in * || cbn [length]).

Lemma gene_size last g : gene_fits g = true ->
  N.of_nat (length (put_gene last g)) <= if is_neuron g then 16 else 26.
Proof.
  intros F. unfold gene_fits in F. apply andb_prop in F as (F & Body). apply andb_prop in F as (C & M).
  apply N.ltb_lt in C, M. unfold put_gene. measure.
  set (leap := counter (mark_of g) - counter last).
  assert (L : (length (if N.leb 15 leap then put_number (N.sub leap 15) else []) <= 10)%nat)
    by (destruct (N.leb 15 leap); [apply varint_size | cbn; lia]).
  assert (R : (length (if negb (N.eqb (maker (mark_of g)) (maker last))
                       then put_number (maker (mark_of g)) else []) <= 5)%nat).
  { destruct (negb _); [|cbn; lia]. apply number_size. cbn. lia. }
  unfold is_neuron. destruct (body_of g) as [k|on rec s t w]; cbn [put_body]; [cbn [length]; lia|].
  apply andb_prop in Body as (Body & W). apply andb_prop in Body as (S_ & T).
  apply N.ltb_lt in S_, T. measure.
  assert (A : (length (put_number s) <= 3)%nat) by (apply number_size; cbn; lia).
  assert (B : (length (put_number t) <= 3)%nat) by (apply number_size; cbn; lia).
  rewrite word_size. lia.
Qed.

Lemma genes_size genes : forall last, forallb gene_fits genes = true ->
  N.of_nat (length (put_genes last genes)) <= 16 * neurons genes + 26 * connections genes.
Proof.
  induction genes as [|g genes IH]; intros last F; cbn [put_genes]; [cbn; lia|].
  cbn [forallb] in F. apply andb_prop in F as (F & Fs). measure.
  assert (S := gene_size last g F). specialize (IH (mark_of g) Fs).
  rewrite neurons_cons. unfold connections in *. cbn [filter].
  destruct (is_neuron g); cbn [negb length]; lia.
Qed.

Theorem encode_total : Claims.encode_total.
Proof.
  intros l m content genes Formed Fits Sender Maker Stamp Energy Neurons Connections Room.
  unfold encode. rewrite Fits. unfold valid_header, valid_genome.
  fold content. fold genes. rewrite (well_formed_passes l _ genes Formed).
  replace (sender m =? 0) with false by (symmetry; now apply N.eqb_neq).
  replace (robot content =? 0) with false by (symmetry; now apply N.eqb_neq).
  replace (genesis_count l <? stamp m) with true by (symmetry; now apply N.ltb_lt).
  rewrite Energy.
  replace (neurons genes <=? neurons_max l) with true by (symmetry; now apply N.leb_le).
  replace (connections genes <=? connections_max l) with true by (symmetry; now apply N.leb_le).
  cbn [negb andb].
  unfold fits in Fits. fold content in Fits. fold genes in Fits.
  repeat (apply andb_prop in Fits as (Fits & ?)).
  repeat match goal with H : (_ <? _) = true |- _ => apply N.ltb_lt in H end.
  assert (G := genes_size genes before_all ltac:(assumption)).
  assert (Payload : size (put_genome content) <= 16 + (16 * neurons genes + 26 * connections genes)).
  { unfold size, put_genome. fold genes. measure.
    assert ((length (put_number (robot content)) <= 5)%nat) by (apply number_size; cbn; lia).
    assert ((length (put_number (birth content)) <= 5)%nat) by (apply number_size; cbn; lia).
    assert ((length (put_number (neurons genes)) <= 3)%nat) by (apply number_size; cbn; lia).
    assert ((length (put_number (connections genes)) <= 3)%nat) by (apply number_size; cbn; lia).
    lia. }
  assert (Small : size (put_genome content) < 2 ^ 32) by lia.
  replace (size (put_genome content) <? 2 ^ 32) with true by (symmetry; now apply N.ltb_lt).
  cbn [andb]. set (frame := _ ++ put_word 4 _).
  assert (A : (length (put_number (sender m)) <= 5)%nat) by (apply number_size; cbn; lia).
  assert (B : (length (put_number (stamp m)) <= 10)%nat) by apply varint_size.
  assert (C : (length (put_number (size (put_genome content))) <= 5)%nat).
  { apply number_size. apply N.lt_trans with (2 ^ 32); [exact Small | reflexivity]. }
  assert (Frame : size frame <= frame_bytes l).
  { unfold frame, put_header. unfold size at 1. rewrite !app_length, !word_size. cbn [length].
    unfold size in Payload. lia. }
  replace (size frame <=? frame_bytes l) with true by (symmetry; now apply N.leb_le).
  now exists frame.
Qed.

(** The codec of the wire format: what is written is read, and nothing else is. *)
From Coq Require Import NArith List Bool Lia Sorting.Sorted.
From GeneClocks Require Import Mark Wire.
From GeneClocks Require Claims.
From GeneClocks.proofs Require Import Order.
Import ListNotations.
Open Scope N_scope.

Local Arguments N.mul : simpl never.
Local Arguments N.add : simpl never.
Local Arguments N.sub : simpl never.
Local Arguments N.div : simpl never.
Local Arguments N.modulo : simpl never.
Local Arguments N.ltb : simpl never.
Local Arguments N.leb : simpl never.
Local Arguments N.eqb : simpl never.
Local Arguments N.pow : simpl never.

Local Arguments put_gene : simpl never.
Local Arguments get_gene : simpl never.
Local Arguments put_number : simpl never.
Local Arguments get_number : simpl never.
Local Arguments mark_admitted : simpl never.

(** ** Readers and writers *)

(** [get] reads exactly what [put] writes, of the values that are [ok]. *)
Definition reads {A} (get : list N -> option (A * list N)) (put : A -> list N) (ok : A -> Prop) :=
  (forall v rest, ok v -> get (put v ++ rest) = Some (v, rest))
  /\ (forall input v rest, get input = Some (v, rest) -> input = put v ++ rest /\ ok v).

(** Takes a decoder apart at its first test. *)
Ltac step :=
  match goal with
  | H : (if ?test then _ else None) = Some _ |- _ =>
      let found := fresh "H" in destruct test eqn:found; [|discriminate H]
  | H : (match ?first with Some _ => _ | None => None end) = Some _ |- _ =>
      let found := fresh "H" in destruct first as [[? ?]|] eqn:found; [|discriminate H]
  end.

Ltac numbers :=
  repeat match goal with
  | H : (_ && _)%bool = true |- _ => apply andb_true_iff in H; destruct H
  | H : (_ <? _) = true |- _ => apply N.ltb_lt in H
  | H : (_ <? _) = false |- _ => apply N.ltb_ge in H
  | H : (_ <=? _) = true |- _ => apply N.leb_le in H
  | H : (_ <=? _) = false |- _ => apply N.leb_gt in H
  | H : (_ =? _) = true |- _ => apply N.eqb_eq in H
  | H : (_ =? _) = false |- _ => apply N.eqb_neq in H
  | H : negb _ = true |- _ => apply negb_true_iff in H
  end.

(** Quotient and remainder by their names: [lia] knows no division. *)
Lemma divided (n d : N) :
  d <> 0 -> exists q r, n / d = q /\ n mod d = r /\ n = r + d * q /\ r < d.
Proof.
  intros nonzero. exists (n / d), (n mod d). repeat split.
  - rewrite N.add_comm. apply N.div_mod, nonzero.
  - apply N.mod_lt, nonzero.
Qed.

Lemma undivided (q r d : N) : r < d -> (r + d * q) / d = q /\ (r + d * q) mod d = r.
Proof.
  intros small. split; symmetry;
    [apply N.div_unique with r | apply N.mod_unique with q]; lia.
Qed.

Lemma power_succ (b : N) (n : nat) : b ^ N.of_nat (S n) = b * b ^ N.of_nat n.
Proof. rewrite Nnat.Nat2N.inj_succ, N.pow_succ_r'. reflexivity. Qed.

(** ** Numbers *)

Lemma varint_reads more :
  reads (get_varint (S more)) (put_varint (S more)) (fun n => n < 128 ^ N.of_nat (S more)).
Proof.
  induction more as [|more [written read]]; split.
  - intros n rest small. change (128 ^ N.of_nat 1) with 128 in small.
    simpl. rewrite (proj2 (N.ltb_lt _ _) small). simpl.
    rewrite (proj2 (N.ltb_lt _ _) small). reflexivity.
  - intros [|b input] n rest got; simpl in got; [discriminate|].
    destruct (b <? 128) eqn:last.
    + injection got as <- <-. numbers. simpl. rewrite (proj2 (N.ltb_lt _ _) last).
      split; [reflexivity | exact last].
    + destruct (b <? 256); discriminate.
  - intros n rest small. rewrite power_succ in small.
    remember (S more) as less. simpl.
    destruct (n <? 128) eqn:last; simpl; [rewrite last; reflexivity|]. numbers.
    destruct (divided n 128 ltac:(lia)) as (q & r & -> & -> & -> & part).
    replace (128 + r <? 128) with false by (symmetry; apply N.ltb_ge; lia).
    replace (128 + r <? 256) with true by (symmetry; apply N.ltb_lt; lia).
    rewrite written by nia.
    replace (q =? 0) with false by (symmetry; apply N.eqb_neq; lia).
    simpl. f_equal. f_equal. lia.
  - intros input n rest got. rewrite power_succ. remember (S more) as less.
    destruct input as [|b input]; simpl in got; [discriminate|].
    destruct (b <? 128) eqn:last.
    + injection got as <- <-. simpl. rewrite last. numbers. split; [reflexivity|].
      assert (128 ^ N.of_nat less <> 0) by (apply N.pow_nonzero; lia). nia.
    + repeat step. injection got as <- <-. numbers.
      destruct (read _ _ _ H0) as [-> small].
      destruct (undivided n0 (b - 128) 128 ltac:(lia)) as [quotient part].
      split; [|nia]. simpl.
      replace (b - 128 + 128 * n0 <? 128) with false by (symmetry; apply N.ltb_ge; lia).
      rewrite quotient, part. simpl. f_equal. lia.
Qed.

Lemma number_reads bound :
  bound <= 128 ^ 10 -> reads (get_number bound) put_number (fun n => n < bound).
Proof.
  intros fits. destruct (varint_reads 9) as [written read]. split.
  - intros n rest small. unfold get_number, put_number.
    rewrite written by (change (N.of_nat 10) with 10; lia).
    rewrite (proj2 (N.ltb_lt _ _) small). reflexivity.
  - intros input n rest got. unfold get_number in got. repeat step. injection got as <- <-.
    destruct (read _ _ _ H) as [-> _]. numbers. split; [reflexivity | assumption].
Qed.

Lemma word_reads bytes :
  reads (get_word bytes) (put_word bytes) (fun n => n < 256 ^ N.of_nat bytes).
Proof.
  induction bytes as [|more [written read]]; split.
  - intros n rest small. change (256 ^ N.of_nat 0) with 1 in small.
    assert (n = 0) as -> by lia. reflexivity.
  - intros input n rest got. injection got as <- <-. split; reflexivity.
  - intros n rest small. rewrite power_succ in small. simpl.
    destruct (divided n 256 ltac:(lia)) as (q & r & -> & -> & -> & part).
    rewrite (proj2 (N.ltb_lt _ _) part), written by nia. reflexivity.
  - intros [|b input] n rest got; simpl in got; [discriminate|].
    repeat step. injection got as <- <-. numbers. destruct (read _ _ _ H0) as [-> small].
    destruct (undivided n0 b 256 ltac:(lia)) as [quotient part].
    rewrite power_succ. split; [|nia]. simpl. rewrite quotient, part. reflexivity.
Qed.

Lemma word_written bytes n rest :
  n < 256 ^ N.of_nat bytes -> get_word bytes (put_word bytes n ++ rest) = Some (n, rest).
Proof. apply word_reads. Qed.

(** ** Genes *)

Definition body_fits (b : body) : Prop :=
  match b with
  | Neuron _ => True
  | Connection _ _ source target weight => source < 2 ^ 16 /\ target < 2 ^ 16 /\ weight < 2 ^ 32
  end.

Lemma number_written bound n rest :
  bound <= 128 ^ 10 -> n < bound -> get_number bound (put_number n ++ rest) = Some (n, rest).
Proof. intros fits. apply number_reads, fits. Qed.

Lemma number_read bound input n rest :
  bound <= 128 ^ 10 -> get_number bound input = Some (n, rest) ->
  input = put_number n ++ rest /\ n < bound.
Proof. intros fits. apply number_reads, fits. Qed.

Lemma body_written b rest :
  body_fits b -> get_body (low_bits b) (put_body b ++ rest) = Some (b, rest).
Proof.
  destruct b as [[]|enabled recurrent source target weight]; try reflexivity.
  intros (small_source & small_target & small_weight).
  assert (numbers_written :
    get_number (2 ^ 16) (put_body (Connection enabled recurrent source target weight) ++ rest)
    = Some (source, put_number target ++ put_word 4 weight ++ rest)).
  { simpl. rewrite <- !app_assoc. apply number_written; [discriminate | assumption]. }
  unfold get_body.
  destruct enabled, recurrent; simpl low_bits; cbv beta iota delta [N.b2n N.mul N.add];
    rewrite numbers_written, number_written, word_written by (assumption || discriminate);
    reflexivity.
Qed.

Lemma body_read low input b rest :
  low < 8 -> get_body low input = Some (b, rest) ->
  input = put_body b ++ rest /\ low_bits b = low /\ body_fits b.
Proof.
  intros small got.
  assert (cases : low = 0 \/ low = 1 \/ low = 2 \/ low = 3 \/ low = 4 \/ low = 5 \/ low = 6
    \/ low = 7) by lia.
  assert (connection : forall enabled recurrent,
    (let* (source, rest) := get_number (2 ^ 16) input in
     let* (target, rest) := get_number (2 ^ 16) rest in
     let* (weight, rest) := get_word 4 rest in
     Some (Connection enabled recurrent source target weight, rest)) = Some (b, rest) ->
    input = put_body b ++ rest /\ body_fits b
    /\ low_bits b = 1 + 2 * N.b2n enabled + 4 * N.b2n recurrent).
  { intros enabled recurrent read. repeat step. injection read as <- <-.
    apply number_read in H; [|discriminate]. apply number_read in H0; [|discriminate].
    apply (proj2 (word_reads 4)) in H1.
    destruct H as [-> ?], H0 as [-> ?], H1 as [-> ?]. simpl. rewrite <- !app_assoc.
    repeat split; assumption. }
  repeat (destruct cases as [->|cases]); try subst low;
    try (injection got as <- <-; repeat split; reflexivity);
    (destruct (connection _ _ got) as (-> & fit & ->); repeat split; trivial; reflexivity).
Qed.

(** What the head of a gene says. *)
Lemma head_parts high other low :
  high < 16 -> low < 8 ->
  let head := 16 * high + 8 * N.b2n other + low in
  head < 256 /\ head / 16 = high /\ (8 <=? head mod 16) = other /\ head mod 8 = low.
Proof.
  intros small_high small_low head. subst head.
  assert (N.b2n other <= 1) by (destruct other; simpl; lia).
  destruct (undivided high (8 * N.b2n other + low) 16 ltac:(lia)) as [quotient part].
  destruct (undivided (2 * high + N.b2n other) low 8 ltac:(lia)) as [_ low_part].
  replace (16 * high + 8 * N.b2n other + low) with (8 * N.b2n other + low + 16 * high) by lia.
  rewrite quotient, part.
  replace (8 * N.b2n other + low + 16 * high) with (low + 8 * (2 * high + N.b2n other)) by lia.
  repeat split; trivial; [lia|].
  destruct other; simpl N.b2n; [apply N.leb_le | apply N.leb_gt]; lia.
Qed.

Lemma head_whole head :
  head < 256 ->
  head = 16 * (head / 16) + 8 * N.b2n (8 <=? head mod 16) + head mod 8
  /\ head / 16 < 16 /\ head mod 8 < 8.
Proof.
  intros small.
  destruct (divided head 16 ltac:(lia)) as (q & r & -> & -> & whole & part).
  assert (eighth : head mod 8 = if 8 <=? r then r - 8 else r).
  { destruct (8 <=? r) eqn:found; numbers; symmetry.
    - apply N.mod_unique with (2 * q + 1); lia.
    - apply N.mod_unique with (2 * q); lia. }
  rewrite eighth. destruct (8 <=? r) eqn:found; numbers; simpl N.b2n; lia.
Qed.

Lemma low_bits_small b : low_bits b < 8.
Proof. destruct b as [[]|[] [] ? ? ?]; reflexivity. Qed.

(** The genes that can be told after [last]. *)
Definition tellable (last : mark) (g : gene) : Prop :=
  counter last <= counter (mark_of g) /\ counter (mark_of g) - counter last < 15 + 2 ^ 64
  /\ maker (mark_of g) < 2 ^ 32 /\ body_fits (body_of g).

Lemma gene_written last g rest :
  tellable last g -> get_gene last (put_gene last g ++ rest) = Some (g, rest).
Proof.
  intros (above & near & small_maker & fit). destruct g as [[c r] b], last as [c0 r0].
  simpl in *. unfold get_gene, put_gene.
  cbn [mark_of body_of counter maker app]. rewrite <- !app_assoc.
  set (leap := c - c0) in *.
  assert (nibble_small : (if 15 <=? leap then 15 else leap) < 16).
  { destruct (15 <=? leap) eqn:far; numbers; lia. }
  destruct (head_parts _ (negb (r =? r0)) _ nibble_small (low_bits_small b))
    as (small & high & other & low).
  rewrite (proj2 (N.ltb_lt _ _) small), high, other, low.
  assert (leap_read : forall more,
    get_leap (if 15 <=? leap then 15 else leap)
      ((if 15 <=? leap then put_number (leap - 15) else []) ++ more) = Some (leap, more)).
  { intros more. unfold get_leap. destruct (15 <=? leap) eqn:far; numbers.
    - rewrite N.eqb_refl, number_written by (discriminate || lia). f_equal. f_equal. lia.
    - replace (leap =? 15) with false by (symmetry; apply N.eqb_neq; lia). reflexivity. }
  rewrite leap_read. clear leap_read.
  assert (maker_read : forall more,
    get_maker (negb (r =? r0)) r0 ((if negb (r =? r0) then put_number r else []) ++ more)
    = Some (r, more)).
  { intros more. unfold get_maker. destruct (r =? r0) eqn:same; simpl; numbers; [subst; reflexivity|].
    rewrite number_written by (discriminate || assumption).
    rewrite (proj2 (N.eqb_neq _ _) same). reflexivity. }
  rewrite maker_read, body_written by assumption.
  replace (c0 + leap) with c by (subst leap; lia). reflexivity.
Qed.

Lemma leap_read nibble input leap rest :
  nibble < 16 -> get_leap nibble input = Some (leap, rest) ->
  input = (if 15 <=? leap then put_number (leap - 15) else []) ++ rest
  /\ nibble = (if 15 <=? leap then 15 else leap) /\ leap < 15 + 2 ^ 64.
Proof.
  intros small got. unfold get_leap in got. destruct (nibble =? 15) eqn:far; numbers.
  - repeat step. injection got as <- <-. apply number_read in H; [|discriminate].
    destruct H as [-> ?]. replace (15 <=? 15 + n) with true by (symmetry; apply N.leb_le; lia).
    replace (15 + n - 15) with n by lia. repeat split; lia.
  - injection got as <- <-.
    replace (15 <=? nibble) with false by (symmetry; apply N.leb_gt; lia).
    repeat split; lia.
Qed.

Lemma maker_read other last input r rest :
  last < 2 ^ 32 -> get_maker other last input = Some (r, rest) ->
  input = (if negb (r =? last) then put_number r else []) ++ rest
  /\ other = negb (r =? last) /\ r < 2 ^ 32.
Proof.
  intros small got. unfold get_maker in got. destruct other.
  - repeat step. injection got as <- <-. apply number_read in H; [|discriminate].
    destruct H as [-> ?]. rewrite H0. repeat split. assumption.
  - injection got as <- <-. rewrite N.eqb_refl. repeat split. assumption.
Qed.

Lemma gene_read last input g rest :
  maker last < 2 ^ 32 -> get_gene last input = Some (g, rest) ->
  input = put_gene last g ++ rest /\ tellable last g.
Proof.
  intros small_last got. destruct input as [|head input]; [discriminate|].
  unfold get_gene in got. repeat step. injection got as <- <-. numbers.
  destruct (head_whole head H) as (whole & small_high & small_low).
  apply leap_read in H0; [|assumption]. destruct H0 as (-> & high & near).
  apply maker_read in H1; [|assumption]. destruct H1 as (-> & other & small).
  apply body_read in H2; [|assumption]. destruct H2 as (-> & low & fit).
  rewrite high, other, <- low in whole.
  unfold put_gene, tellable. cbn [mark_of body_of counter maker].
  replace (counter last + n - counter last) with n by lia.
  rewrite whole, <- !app_assoc. repeat split; trivial; lia.
Qed.

(** ** Lists of genes *)

(** What [admitted] has to say about marks, and what fits, make genes tellable. *)
Fixpoint all_tellable (last : mark) (genes : list gene) : Prop :=
  match genes with
  | [] => True
  | g :: others => tellable last g /\ all_tellable (mark_of g) others
  end.

Lemma genes_written genes : forall last rest,
  all_tellable last genes ->
  get_genes (length genes) last (put_genes last genes ++ rest) = Some (genes, rest).
Proof.
  induction genes as [|g others IH]; intros last rest; [reflexivity|].
  intros [tell tell_others]. cbn [put_genes get_genes length].
  rewrite <- app_assoc, gene_written by assumption. rewrite IH by assumption.
  reflexivity.
Qed.

Lemma genes_read count : forall last input genes rest,
  maker last < 2 ^ 32 -> get_genes count last input = Some (genes, rest) ->
  input = put_genes last genes ++ rest /\ all_tellable last genes /\ length genes = count.
Proof.
  induction count as [|count IH]; intros last input genes rest small got.
  - injection got as <- <-. repeat split.
  - simpl in got. repeat step. injection got as <- <-.
    apply gene_read in H; [|assumption]. destruct H as [-> tell].
    apply IH in H0; [|apply tell]. destruct H0 as (-> & tell_others & <-).
    cbn [put_genes]. rewrite <- app_assoc. repeat split; trivial; apply tell.
Qed.

Lemma admitted_tellable l stamp genes : forall last kinds joined,
  stamp < 2 ^ 64 -> admitted l stamp last kinds joined genes = true ->
  forallb gene_fits genes = true -> all_tellable last genes.
Proof.
  induction genes as [|g others IH]; intros last kinds joined small allowed fit; [exact I|].
  simpl in allowed, fit. apply andb_true_iff in allowed, fit.
  destruct allowed as [allowed_mark allowed], fit as [fit_gene fit].
  unfold mark_admitted in allowed_mark. numbers.
  split.
  - unfold gene_fits in fit_gene. numbers.
    assert (counter last <= counter (mark_of g)).
    { unfold N.le. intros below. unfold mark_compare in *. rewrite below in *. discriminate. }
    split; [assumption|]. split; [lia|]. split; [assumption|].
    destruct (body_of g); simpl; [exact I|]. numbers. repeat split; assumption.
  - destruct (body_of g); numbers; eapply IH; eassumption.
Qed.

Lemma told_fit l stamp genes : forall last kinds joined,
  stamp < 2 ^ 64 -> admitted l stamp last kinds joined genes = true ->
  all_tellable last genes -> forallb gene_fits genes = true.
Proof.
  induction genes as [|g others IH]; intros last kinds joined small allowed tell; [reflexivity|].
  simpl in allowed. apply andb_true_iff in allowed. destruct allowed as [allowed_mark allowed].
  destruct tell as [(_ & _ & small_maker & fit) tell]. unfold mark_admitted in allowed_mark.
  simpl. apply andb_true_iff. split.
  - numbers. unfold gene_fits.
    replace (counter (mark_of g) <? 2 ^ 64) with true by (symmetry; apply N.ltb_lt; lia).
    rewrite (proj2 (N.ltb_lt _ _) small_maker).
    destruct (body_of g); [reflexivity|]. destruct fit as (fit_source & fit_target & fit_weight).
    apply N.ltb_lt in fit_source, fit_target, fit_weight.
    rewrite fit_source, fit_target, fit_weight. reflexivity.
  - destruct (body_of g); numbers; eapply IH; eassumption.
Qed.

(** ** Genomes *)

Lemma counts genes :
  N.to_nat (neurons genes + connections genes) = length genes.
Proof.
  unfold neurons, connections. rewrite <- Nnat.Nat2N.inj_add, Nnat.Nat2N.id.
  induction genes as [|g others IH]; [reflexivity|].
  simpl. destruct (is_neuron g); simpl; lia.
Qed.

Definition genome_fits (g : genome) : Prop :=
  robot g < 2 ^ 32 /\ birth g < 2 ^ 32 /\ neurons (genes g) < 2 ^ 16
  /\ connections (genes g) < 2 ^ 16 /\ forallb gene_fits (genes g) = true.

Lemma genome_written l stamp g :
  stamp < 2 ^ 64 -> genome_fits g -> valid_genome l stamp g = true ->
  get_genome l stamp (put_genome g) = Some g.
Proof.
  intros small (small_robot & small_birth & few_neurons & few_connections & fit) valid.
  destruct g as [robot birth genes]. simpl in *. unfold get_genome, put_genome. simpl.
  rewrite !number_written by (assumption || discriminate).
  pose proof valid as all_valid. unfold valid_genome in valid. simpl in valid.
  repeat match type of valid with (_ && _)%bool = true =>
    let rest := fresh "valid" in apply andb_true_iff in valid; destruct valid as [valid rest] end.
  rewrite valid2, valid1, counts. simpl.
  rewrite <- (app_nil_r (put_genes before_all genes)), genes_written.
  - rewrite N.eqb_refl, all_valid. reflexivity.
  - eapply admitted_tellable; eassumption.
Qed.

Lemma genome_read l stamp input g :
  stamp < 2 ^ 64 -> get_genome l stamp input = Some g ->
  input = put_genome g /\ genome_fits g /\ valid_genome l stamp g = true.
Proof.
  intros small got. unfold get_genome in got. repeat step. injection got as <-.
  apply number_read in H; [|discriminate]. destruct H as [-> small_robot].
  apply number_read in H0; [|discriminate]. destruct H0 as [-> small_birth].
  apply number_read in H1; [|discriminate]. destruct H1 as [-> few_neurons].
  apply number_read in H2; [|discriminate]. destruct H2 as [-> few_connections].
  apply genes_read in H4; [|reflexivity]. destruct H4 as (-> & tell & total).
  apply andb_true_iff in H5. destruct H5 as [ended valid].
  apply andb_true_iff in ended. destruct ended as [ended count].
  match type of ended with match ?rest with _ => _ end = _ =>
    destruct rest; [|discriminate ended] end.
  apply N.eqb_eq in count. rewrite <- counts, count in total.
  apply Nnat.N2Nat.inj in total. apply N.add_cancel_l in total. subst.
  unfold put_genome. cbn [robot birth genes]. rewrite app_nil_r.
  split; [reflexivity|]. split; [|exact valid].
  repeat split; trivial. cbn [genes].
  unfold valid_genome in valid. cbn [genes] in valid. apply andb_true_iff in valid.
  eapply told_fit; [exact small | apply valid | exact tell].
Qed.

(** ** Frames *)

Lemma word_size bytes n : length (put_word bytes n) = bytes.
Proof. revert n. induction bytes as [|bytes IH]; intros n; simpl; [|rewrite IH]; reflexivity. Qed.

Lemma sum_small input : crc32c input < 256 ^ 4.
Proof. apply N.mod_lt. discriminate. Qed.

Lemma content_fits m :
  fits m = true ->
  sender m < 2 ^ 32 /\ stamp m < 2 ^ 64 /\ energy m < 2 ^ 32 /\ genome_fits (content m).
Proof. unfold fits. intros fit. numbers. repeat split; assumption. Qed.

Lemma some_equal {A} (a b : A) : Some a = Some b -> a = b.
Proof. congruence. Qed.

Lemma front {A} (a b : list A) (n : nat) : n = length a -> firstn n (a ++ b) = a.
Proof.
  intros ->. rewrite firstn_app, PeanoNat.Nat.sub_diag, firstn_all. apply app_nil_r.
Qed.

Lemma back {A} (a b : list A) (n : nat) : n = length a -> skipn n (a ++ b) = b.
Proof. intros ->. rewrite skipn_app, PeanoNat.Nat.sub_diag, skipn_all. reflexivity. Qed.

Theorem decode_encode : Claims.decode_encode.
Proof.
  intros l m frame encoded. unfold encode in encoded. step. step. apply some_equal in encoded. subst frame.
  apply andb_true_iff in H. destruct H as [H valid].
  apply andb_true_iff in H. destruct H as [fit header].
  destruct (content_fits m fit) as (small_sender & small_stamp & small_energy & genome_fit).
  apply andb_true_iff in H0. destruct H0 as [small_payload fits_frame].
  set (payload := put_genome (content m)) in *.
  set (before_sum := put_header m payload ++ payload) in *.
  set (sum := put_word 4 (crc32c before_sum)) in *.
  assert (parts : before_sum ++ sum = put_word 1 version ++ put_number (sender m)
    ++ put_number (stamp m) ++ put_word 4 (energy m) ++ put_number (size payload)
    ++ payload ++ sum).
  { unfold before_sum, put_header. rewrite <- !app_assoc. reflexivity. }
  apply N.ltb_lt in small_payload.
  assert (four : length sum = 4%nat) by apply word_size.
  unfold decode. rewrite fits_frame.
  rewrite (front before_sum sum) by (rewrite app_length, four; lia).
  rewrite parts, word_written by reflexivity. rewrite N.eqb_refl.
  rewrite !number_written by (assumption || discriminate).
  rewrite word_written by exact small_energy.
  rewrite number_written by (assumption || discriminate).
  unfold size at 1. rewrite app_length, four.
  replace (N.of_nat (length payload + 4) =? size payload + 4) with true
    by (symmetry; apply N.eqb_eq; unfold size; lia).
  rewrite (front payload sum), (back payload sum) by (unfold size; apply Nnat.Nat2N.id).
  unfold sum at 1. rewrite <- (app_nil_r (put_word 4 _)), word_written by apply sum_small.
  assert (content_read : get_genome l (stamp m) payload = Some (content m))
    by (apply genome_written; assumption).
  rewrite N.eqb_refl, content_read.
  replace (Message _ _ _ _) with m by (destruct m; reflexivity).
  rewrite header. reflexivity.
Qed.

Theorem decode_canonical : Claims.decode_canonical.
Proof.
  intros l frame m decoded. unfold decode in decoded. step. step. step. step. step. step. step. step. step. step.
  destruct (get_genome _ _ _) as [g|] eqn:read in decoded; [|discriminate decoded].
  step. apply some_equal in decoded. subst m.
  apply (proj2 (word_reads 1)) in H0. destruct H0 as [-> _].
  apply number_read in H2; [|discriminate]. destruct H2 as [-> small_sender].
  apply number_read in H3; [|discriminate]. destruct H3 as [-> small_stamp].
  apply (proj2 (word_reads 4)) in H4. destruct H4 as [-> small_energy].
  apply number_read in H5; [|discriminate]. destruct H5 as [-> small_payload].
  apply (proj2 (word_reads 4)) in H7. destruct H7 as [sum _].
  change (256 ^ N.of_nat 4) with (2 ^ 32) in small_energy. numbers. subst n.
  assert (whole := firstn_skipn (N.to_nat n3) l4).
  assert (payload_size : length (firstn (N.to_nat n3) l4) = N.to_nat n3)
    by (unfold size in *; apply firstn_length_le; lia).
  apply genome_read in read; [|exact small_stamp]. destruct read as (payload & genome_fit & valid).
  rewrite payload in whole, payload_size. rewrite sum in whole.
  assert (l5 = []) as ->.
  { apply length_zero_iff_nil. apply (f_equal (@length N)) in whole.
    rewrite !app_length, word_size in whole. unfold size in *. lia. }
  rewrite app_nil_r in whole. subst l4. clear payload sum.
  assert (n3 = size (put_genome g)) as -> by (unfold size; lia).
  set (m := Message n0 n1 n2 g) in *.
  set (before_sum := put_header m (put_genome g) ++ put_genome g).
  assert (parts : put_word 1 version ++ put_number n0 ++ put_number n1 ++ put_word 4 n2
    ++ put_number (size (put_genome g)) ++ put_genome g ++ put_word 4 n4
    = before_sum ++ put_word 4 n4).
  { unfold before_sum, put_header. rewrite <- !app_assoc. reflexivity. }
  rewrite parts in *.
  rewrite (front before_sum) in H8 by (rewrite app_length, word_size; lia). subst n4.
  unfold encode. change (content m) with g. change (stamp m) with n1.
  fold before_sum.
  assert (fit : fits m = true).
  { destruct genome_fit as (small_robot & small_birth & few_neurons & few_connections & genes_fit).
    apply N.ltb_lt in small_sender, small_stamp, small_energy, small_robot, small_birth,
      few_neurons, few_connections.
    unfold fits, m. cbn [sender stamp energy content].
    rewrite small_sender, small_stamp, small_energy, small_robot, small_birth, few_neurons,
      few_connections. exact genes_fit. }
  rewrite fit, H9, valid. apply N.ltb_lt in small_payload. apply N.leb_le in H.
  rewrite small_payload, H. reflexivity.
Qed.

(** ** What is read can be aligned and observed *)

Lemma admitted_marks l stamp genes : forall last kinds joined,
  admitted l stamp last kinds joined genes = true ->
  sorted (last :: map mark_of genes)
  /\ Forall (fun g => 1 <= counter (mark_of g) < stamp
                      /\ (maker (mark_of g) = 0 <-> counter (mark_of g) <= genesis_count l)) genes.
Proof.
  induction genes as [|g others IH]; intros last kinds joined allowed.
  - split; [repeat constructor | constructor].
  - simpl in allowed. apply andb_true_iff in allowed. destruct allowed as [allowed_mark allowed].
    assert (rest : sorted (mark_of g :: map mark_of others)
      /\ Forall (fun g => 1 <= counter (mark_of g) < stamp
           /\ (maker (mark_of g) = 0 <-> counter (mark_of g) <= genesis_count l)) others)
      by (destruct (body_of g); numbers; eapply IH; eassumption).
    destruct rest as [others_sorted others_right].
    unfold mark_admitted in allowed_mark.
    apply andb_true_iff in allowed_mark. destruct allowed_mark as [allowed_mark genesis].
    apply andb_true_iff in allowed_mark. destruct allowed_mark as [allowed_mark positive].
    apply andb_true_iff in allowed_mark. destruct allowed_mark as [above below].
    apply N.ltb_lt in below. apply N.leb_le in positive. apply eqb_prop in genesis.
    assert (last << mark_of g)
      by (unfold mark_lt; destruct (mark_compare last (mark_of g)); congruence).
    split.
    + constructor; [assumption|]. constructor; [assumption|].
      inversion others_sorted as [|? ? _ all_above]. subst.
      eapply Forall_impl; [|exact all_above]. intros m greater. eapply mark_lt_transitive; eassumption.
    + constructor; [|assumption]. split; [split; assumption|].
      rewrite <- N.eqb_eq, <- N.leb_le, genesis. reflexivity.
Qed.

Theorem decoded_is_in_order : Claims.decoded_is_in_order.
Proof.
  intros l frame m decoded. apply decode_canonical in decoded. unfold encode in decoded.
  repeat step. apply andb_true_iff in H. destruct H as [_ valid].
  unfold valid_genome in valid. apply andb_true_iff in valid. destruct valid as [_ allowed].
  apply admitted_marks in allowed. destruct allowed as [in_order right].
  split; [|exact right]. inversion in_order. assumption.
Qed.

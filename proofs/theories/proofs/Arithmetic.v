(** The arithmetic of one clock. *)
From Coq Require Import NArith Bool Lia.
From GeneClocks Require Import Clock.
From GeneClocks Require Claims.
Open Scope N_scope.

Lemma reserve_spec l c : next c <= maximum l ->
  next (reserve l c) = next c
  /\ durable (reserve l c)
     = if durable c <? next c then N.min (next c + block l) (maximum l) else durable c.
Proof. intros. unfold reserve. destruct (N.ltb_spec (durable c) (next c)); cbn; lia. Qed.

Lemma reserve_ok l c : next c <= maximum l -> durable c <= maximum l ->
  next (reserve l c) = next c /\ next c <= durable (reserve l c) <= maximum l
  /\ durable c <= durable (reserve l c)
  /\ durable (reserve l c) <= N.max (durable c) (next c + block l).
Proof. intros. unfold reserve. destruct (N.ltb_spec (durable c) (next c)); cbn; lia. Qed.

Lemma mint_some l c count first c' : next c <= durable c -> durable c <= maximum l ->
  mint l c count = Some (first, c') ->
  first = next c /\ next c' = next c + count /\ next c' <= durable c' <= maximum l
  /\ durable c <= durable c' <= N.max (durable c) (next c' + block l).
Proof.
  intros A B. unfold mint. destruct (N.ltb_spec (maximum l - next c) count); [discriminate|].
  intros [= <- <-].
  destruct (reserve_ok l (Clock (next c + count) (durable c))) as (-> & ? & ? & ?);
    cbn in *; lia.
Qed.

Lemma mint_none l c count : next c <= maximum l ->
  mint l c count = None <-> maximum l < next c + count.
Proof.
  intros. unfold mint. destruct (N.ltb_spec (maximum l - next c) count); split; intros; try lia.
  - reflexivity.
  - discriminate.
Qed.

Lemma observe_none l c stamp :
  observe l c stamp = None <-> maximum l < stamp \/ next c + window l < stamp.
Proof.
  unfold observe. destruct (N.ltb_spec (maximum l) stamp); [split; auto|].
  destruct (N.ltb_spec (next c) stamp); [|split; [discriminate | lia]].
  destruct (N.ltb_spec (window l) (stamp - next c)); split; auto; try discriminate; lia.
Qed.

Lemma observe_some l c stamp c' : next c <= durable c -> durable c <= maximum l ->
  observe l c stamp = Some c' ->
  next c' = N.max (next c) stamp /\ next c' <= durable c' <= maximum l
  /\ durable c <= durable c' <= N.max (durable c) (next c' + block l)
  /\ stamp <= maximum l /\ stamp <= next c + window l.
Proof.
  intros A B. unfold observe. destruct (N.ltb_spec (maximum l) stamp); [discriminate|].
  destruct (N.ltb_spec (next c) stamp).
  - destruct (N.ltb_spec (window l) (stamp - next c)); [discriminate|]. intros [= <-].
    destruct (reserve_ok l (Clock stamp (durable c))) as (-> & ? & ? & ?); cbn in *; lia.
  - intros [= <-]. lia.
Qed.

Theorem observe_admits : Claims.observe_admits.
Proof. exact observe_none. Qed.

Theorem observe_is_maximum : Claims.observe_is_maximum.
Proof.
  intros l c stamp c'. unfold observe. destruct (N.ltb_spec (maximum l) stamp); [discriminate|].
  destruct (N.ltb_spec (next c) stamp).
  - destruct (window l <? stamp - next c); [discriminate|]. intros [= <-].
    unfold reserve; cbn. destruct (durable c <? stamp); cbn; lia.
  - intros [= <-]. lia.
Qed.

Theorem reserve_is_a_block_ahead : Claims.reserve_is_a_block_ahead.
Proof.
  intros l c H. destruct (reserve_spec l c H) as [-> ->].
  destruct (N.ltb_spec (durable c) (next c)); repeat split; intros; lia.
Qed.

Theorem restore_admits : Claims.restore_admits.
Proof.
  intros l n d. unfold restore.
  destruct (N.eqb_spec n 0), (N.ltb_spec d n), (N.ltb_spec (maximum l) d); cbn;
    split; intros; try reflexivity; lia.
Qed.

Theorem restart_admits : Claims.restart_admits.
Proof.
  intros l s. unfold restart. destruct (restore_admits l s s) as (Some_ & None_).
  destruct (N.leb_spec s (genesis_count l)); split; intros;
    solve [reflexivity | lia | apply Some_; lia | apply None_; lia].
Qed.

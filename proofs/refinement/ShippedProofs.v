(** * A swarm whose clocks are the shipped functions is the model's swarm *)
From Coq Require Import ZArith NArith String List Bool Lia.
From Refinement Require Import Semantics Kernel Statements Execution Shipped.
From GeneClocks Require Import Mark Clock Admission Protocol.
From GeneClocks.proofs Require Import Invariant Safety Durability.
From Refinement Require Import RestoreProofs MintProofs ObserveProofs AllowanceProofs LoopProofs.
Import ListNotations.
Open Scope N_scope.

(** ** What a function computes is what running it gives *)

Lemma run_c_computes rounds f arguments m result m' :
  computes_in rounds f arguments m result m' ->
  exists m'', run_c rounds f arguments m = Some (result, m'') /\ forall a, m'' a = m' a.
Proof.
  intros known. destruct (known (fun _ _ m => m) (S rounds) ltac:(lia)) as (m'' & runs & same).
  exists m''. unfold run_c. rewrite runs. split; [reflexivity|exact same].
Qed.

Lemma clock_in_value m a c : m a = Some (clock_value c) -> clock_in m a = Some c.
Proof.
  intros found. unfold clock_in. rewrite found. destruct c. cbn. now rewrite !N2Z.id.
Qed.
Lemma number_in_value m a n : m a = Some (number_value n) -> number_in m a = Some n.
Proof. intros found. unfold number_in. rewrite found. cbn. now rewrite N2Z.id. Qed.

Lemma laid_clock c l more genome : clock_fits c -> limits_fit l ->
  clock_at (laid (clock_value c :: limits_value l :: more) genome) (object 0) (object 1) c l.
Proof. intros. split; [reflexivity|split; [reflexivity|split; [discriminate|now split]]]. Qed.

Lemma laid_genome genome : fits size_t (N.of_nat (length genome)) ->
  genome_at (laid [] genome) (object 9) genome.
Proof.
  intros fit. split; [exact fit|]. intros k gene found. unfold laid, offset, object. cbn [fst snd].
  change (9 =? 9) with true. cbn [Z.add]. destruct (Z.leb_spec 0 (Z.of_nat k)); [|lia].
  rewrite Nat2Z.id, found. reflexivity.
Qed.

(** ** Each function *)

Ltac ran known :=
  let m := fresh "m" in let runs := fresh "runs" in let after := fresh "after" in
  destruct (run_c_computes _ _ _ _ _ _ known) as (m & runs & after);
  rewrite runs; clear runs known; cbn [bool_value].

Lemma shipped_mint_is l c count : clock_fits c -> limits_fit l -> next c <= maximum l ->
  fits gene_clocks_counter count -> shipped_mint l c count = mint l c count.
Proof.
  intros cf lf below its. unfold shipped_mint.
  assert (known := gene_clocks_mint_refines (laid [clock_value c; limits_value l; Undefined] [])
    (object 0) (object 1) (object 2) c l count (laid_clock c l [Undefined] [] cf lf)
    ltac:(discriminate) ltac:(discriminate) ltac:(discriminate) below its).
  cbn zeta in known. unfold to. destruct (mint l c count) as [[taken c']|]; ran known; [|reflexivity].
  rewrite (number_in_value _ _ taken), (clock_in_value _ _ c'); [reflexivity| |];
    rewrite after; [rewrite write_other by discriminate|]; apply write_same.
Qed.

Lemma shipped_clock_is f more l c answer :
  takes_up f ([to 0; to 1] ++ more)%list (laid [clock_value c; limits_value l] []) (object 0) answer ->
  shipped_clock f more l c = answer.
Proof.
  unfold takes_up, shipped_clock. intros known. destruct answer as [c'|]; ran known; [|reflexivity].
  apply clock_in_value. rewrite after. apply write_same.
Qed.

Lemma shipped_observe_is l c stamp : clock_fits c -> limits_fit l -> fits gene_clocks_counter stamp ->
  shipped_observe l c stamp = observe l c stamp.
Proof.
  intros cf lf its. apply shipped_clock_is, gene_clocks_observe_refines; [|exact its].
  now apply laid_clock.
Qed.

Lemma zero_fits : clock_fits (Clock 0 0).
Proof. split; unfold fits; cbn; lia. Qed.

Lemma shipped_start_is l : limits_fit l -> valid l -> shipped_start l = Some (Clock (start l) (start l)).
Proof.
  intros lf Valid. unfold shipped_start.
  erewrite shipped_clock_is;
    [|apply gene_clocks_start_refines with (old := Clock 0 0);
      [now apply laid_clock; [apply zero_fits|]|destruct lf; unfold valid, fits in *; lia]].
  unfold valid in Valid. apply N.ltb_lt in Valid. now rewrite Valid.
Qed.

Lemma shipped_restart_is l stored : limits_fit l -> genesis_count l <= maximum l ->
  fits gene_clocks_counter stored -> shipped_restart l stored = restart l stored.
Proof.
  intros lf below its. apply shipped_clock_is.
  apply gene_clocks_restart_refines with (old := Clock 0 0);
    [now apply laid_clock; [apply zero_fits|]|destruct lf; unfold fits in *; lia|exact its].
Qed.

Lemma shipped_covers_is stamp genome : fits size_t (N.of_nat (length genome)) ->
  shipped_covers stamp genome = covers stamp genome.
Proof.
  intros fit. unfold shipped_covers.
  assert (known := gene_clocks_covers_refines (laid [] genome) (object 9) genome stamp
                     (laid_genome genome fit)).
  unfold to. destruct (covers stamp genome); ran known; reflexivity.
Qed.

Lemma shipped_find_unmade_is next robot genome : fits size_t (N.of_nat (length genome)) ->
  shipped_find_unmade next robot genome = Some (N.of_nat (find_unmade next robot genome)).
Proof.
  intros fit. unfold shipped_find_unmade.
  assert (known := gene_clocks_find_unmade_refines (laid [] genome) (object 9) genome next robot
                     (laid_genome genome fit)).
  unfold to. ran known. f_equal. lia.
Qed.

Lemma find_unmade_finds next robot genome :
  (find_unmade next robot genome <? length genome)%nat = existsb (unmade next robot) genome.
Proof.
  induction genome as [|gene rest again]; [reflexivity|]. cbn [find_unmade existsb length].
  destruct (unmade next robot gene); [reflexivity|]. cbn [orb]. now rewrite <- again.
Qed.

Lemma shipped_elapse_is g : policy_fits (law g) -> allowance g <= ceiling (law g) ->
  shipped_elapse g = elapse g.
Proof.
  intros (_ & cf & pf) below. unfold shipped_elapse, elapse.
  assert (known := gene_clocks_earn_refines (laid [number_value (allowance g)] []) (object 0)
    (allowance g) (law g) eq_refl below cf pf).
  unfold to. ran known. rewrite (number_in_value _ _ (earn (law g) (allowance g))); [reflexivity|].
  rewrite after. apply write_same.
Qed.

Lemma refusal_of_value why z : refusal_value why = Int z ->
  (z =? gene_clocks_admitted)%Z = false /\ refusal_of z = why.
Proof. destruct why; cbn; intros [= <-]; split; reflexivity. Qed.

Lemma accept_keeps_law l c g stamp c' g' : accept l c g stamp = inl (c', g') -> law g' = law g.
Proof.
  unfold accept. destruct (observe l c stamp); [|discriminate].
  destruct (_ <? _); [discriminate|]. now intros [= _ <-].
Qed.

Lemma shipped_admit_is l c g stamp : clock_fits c -> limits_fit l ->
  fits gene_clocks_counter (allowance g) -> fits gene_clocks_counter stamp ->
  shipped_admit l c g stamp = accept l c g stamp.
Proof.
  intros cf lf af its. unfold shipped_admit.
  assert (known := gene_clocks_admit_refines
    (laid [clock_value c; limits_value l; number_value (allowance g)] []) (object 0) (object 1)
    (object 2) c l g stamp (laid_clock c l [number_value (allowance g)] [] cf lf) eq_refl
    ltac:(discriminate) ltac:(discriminate) af its).
  cbn zeta in known. unfold to. destruct (accept l c g stamp) as [[c' g']|why] eqn:accepted.
  - ran known. rewrite Z.eqb_refl, (clock_in_value _ _ c'), (number_in_value _ _ (allowance g')).
    + apply accept_keeps_law in accepted. destruct g'. cbn in *. now rewrite accepted.
    + rewrite after. apply write_same.
    + rewrite after. rewrite write_other by discriminate. apply write_same.
  - destruct (run_c_computes _ _ _ _ _ _ known) as (m & runs & _). rewrite runs.
    destruct (refusal_value why) as [z| | | |] eqn:code; try (destruct why; discriminate).
    destruct (refusal_of_value why z code) as [-> ->]. reflexivity.
Qed.

Lemma shipped_pass_is l r c g stamp genes : clock_fits c -> limits_fit l ->
  fits gene_clocks_counter (allowance g) -> fits gene_clocks_counter stamp ->
  fits size_t (N.of_nat (length genes)) ->
  shipped_pass l r c g stamp genes = pass l r c g stamp genes.
Proof.
  intros. unfold shipped_pass, pass. rewrite shipped_find_unmade_is, shipped_admit_is by assumption.
  rewrite <- find_unmade_finds.
  destruct (N.ltb_spec (N.of_nat (find_unmade (next c) r genes)) (N.of_nat (length genes))),
    (Nat.ltb_spec (find_unmade (next c) r genes) (length genes)); try lia; reflexivity.
Qed.

(** ** The world *)

Section World.
Context (l : limits) (Valid : valid l) (limits_ok : limits_fit l).

Definition gate_fits (g : gate) : Prop :=
  policy_fits (law g) /\ allowance g <= ceiling (law g).
Definition robot_fits (s : robot) : Prop :=
  fits gene_clocks_counter (block_of s)
  /\ match guard s with Some g => gate_fits g | None => True end.
Definition world_fits (w : world) : Prop :=
  (forall r, robot_fits (robots w r))
  /\ forall m, In m (network w) -> fits size_t (N.of_nat (length (genes m))).

Lemma fits_below n k : n <= k -> fits gene_clocks_counter k -> fits gene_clocks_counter n.
Proof. unfold fits. lia. Qed.

Lemma own_limits_fit s : robot_fits s -> limits_fit (own_limits l s).
Proof. intros [bf _]. destruct limits_ok as (mf & _ & wf). now split; [|split]. Qed.

Lemma memory_fits w r : invariant l w -> clock_fits (memory (robots w r)).
Proof.
  intros I. destruct (robots_ok l w I r) as (order & below & _), limits_ok as (mf & _).
  split; apply (fits_below _ (maximum l)); auto; lia.
Qed.

Lemma gate_allowance_fits g : gate_fits g -> fits gene_clocks_counter (allowance g).
Proof. intros [(_ & cf & _) below]. now apply (fits_below _ (ceiling (law g))). Qed.

Lemma learn_is w r m : invariant l w -> world_fits w -> fits gene_clocks_counter (stamp m) ->
  fits size_t (N.of_nat (length (genes m))) ->
  learn shipped l r (robots w r) m = learn gene_clocks l r (robots w r) m.
Proof.
  intros I (rf & _) sf gf. assert (cf := memory_fits w r I). assert (lf := own_limits_fit _ (rf r)).
  unfold learn. cbn [credible merge gated shipped gene_clocks].
  rewrite shipped_covers_is by exact gf. change (covers (stamp m) (genes m))
    with (forallb (fun gene => counter gene <? stamp m) (genes m)).
  destruct (rf r) as [_ guarded]. destruct (guard (robots w r)) as [g|].
  - rewrite shipped_pass_is by auto using gate_allowance_fits. reflexivity.
  - rewrite shipped_observe_is by assumption. reflexivity.
Qed.

Lemma hear_is w r m how : invariant l w -> world_fits w -> fits gene_clocks_counter (stamp m) ->
  fits size_t (N.of_nat (length (genes m))) ->
  hear shipped l w r m how = hear gene_clocks l w r m how.
Proof. intros. unfold hear. now rewrite learn_is. Qed.

Lemma stamp_fits w m : invariant l w -> In m (network w) -> fits gene_clocks_counter (stamp m).
Proof.
  intros I here. destruct (In_nth_error _ _ here) as [k found].
  destruct (messages_were_sent l w I k m found) as (e & J & sent).
  assert (E := events_ok l w I e J). unfold event_ok in E. rewrite sent in E.
  destruct E as (below & m' & found' & stamped & _). replace m' with m in * by congruence.
  destruct (events_past l w I e J) as (_ & _ & past).
  destruct (robots_ok l w I (place e)) as (order & bound & _), limits_ok as (mf & _).
  apply (fits_below _ (maximum l)); auto. lia.
Qed.

Lemma nothing_fits : fits size_t 0.
Proof. unfold fits. cbn. lia. Qed.

Lemma step_is w c : invariant l w -> world_fits w -> representable c ->
  shipped_step l w c = step gene_clocks l w c.
Proof.
  intros I wf rep. pose proof wf as (rf & nf).
  destruct c as [r count|r selection|r k|r k|r m|r|r value|r anew]; cbn [shipped_step].
  - destruct (robots_ok l w I r) as (order & below & _). cbn [step].
    rewrite shipped_mint_is; [reflexivity|now apply memory_fits|now apply own_limits_fit|cbn; lia|exact rep].
  - reflexivity.
  - cbn [step]. destruct (nth_error (network w) k) as [m|] eqn:found; [|reflexivity].
    apply nth_error_In in found. rewrite hear_is; eauto using stamp_fits.
  - cbn [step]. destruct (nth_error (network w) k) as [m|] eqn:found; [|reflexivity].
    apply nth_error_In in found.
    rewrite hear_is; auto; [exact (stamp_fits w m I found)|apply nothing_fits].
  - cbn [step]. destruct rep. now rewrite hear_is.
  - cbn [step]. destruct (rf r) as [_ guarded].
    destruct (guard (robots w r)) as [g|]; [|reflexivity]. destruct guarded. cbn [option_map].
    now rewrite shipped_elapse_is.
  - reflexivity.
  - cbn [step resume retains shipped gene_clocks]. rewrite shipped_restart_is; [reflexivity|exact limits_ok| |].
    + unfold valid in Valid. lia.
    + destruct (robots_ok l w I r) as (_ & _ & bound & _), limits_ok as (mf & _).
      apply (fits_below _ (maximum l)); auto; lia.
Qed.

(** ** What is told to the swarm still fits after each step *)

Lemma update_fits robots r new : (forall r, robot_fits (robots r)) -> robot_fits new ->
  forall r', robot_fits (update robots r new r').
Proof. intros rf nf r'. unfold update. now destruct (r' =? r). Qed.

Lemma passed_gate_fits l' r c g stamp genes c' g' : gate_fits g ->
  pass l' r c g stamp genes = inl (c', g') -> gate_fits g'.
Proof.
  intros [pf below]. unfold pass, accept. destruct (existsb _ _); [discriminate|].
  destruct (observe l' c stamp); [|discriminate]. destruct (N.ltb_spec (allowance g) (next c0 - next c));
    [discriminate|]. intros [= _ <-]. split; cbn; [exact pf|lia].
Qed.

Lemma hear_fits w r m how : world_fits w -> world_fits (fst (hear gene_clocks l w r m how)).
Proof.
  intros (rf & nf). unfold hear, learn. cbn [credible merge gated gene_clocks].
  destruct (forallb _ _); [|now split]. pose proof (rf r) as [bf gf].
  destruct (guard (robots w r)) as [g|].
  - destruct (pass _ _ _ _ _ _) as [[c g']|] eqn:passed; [|now split].
    split; cbn; [|intros m'; rewrite app_nil_r; apply nf].
    apply update_fits; [exact rf|]. split; cbn; [exact bf|]. now apply passed_gate_fits in passed.
  - destruct (observe _ _ _); [|now split]. split; cbn; [|intros m'; rewrite app_nil_r; apply nf].
    apply update_fits; [exact rf|]. now split.
Qed.

Lemma filter_fits (f : mark -> bool) genes : fits size_t (N.of_nat (length genes)) ->
  fits size_t (N.of_nat (length (filter f genes))).
Proof.
  assert (length (filter f genes) <= length genes)%nat; [|unfold fits; lia].
  induction genes as [|gene rest again]; cbn; [lia|]. destruct (f gene); cbn; lia.
Qed.

Lemma step_fits w c : world_fits w -> representable c -> world_fits (fst (step gene_clocks l w c)).
Proof.
  intros wf rep. pose proof wf as (rf & nf).
  destruct c as [r count|r selection|r k|r k|r m|r|r value|r anew]; cbn [step].
  - destruct (mint _ _ _) as [[first c]|]; [|exact wf]. pose proof (rf r) as [bf gf].
    split; cbn; [|intros m'; rewrite app_nil_r; apply nf]. apply update_fits; [exact rf|now split].
  - destruct (may_send _ _); [|exact wf]. split; cbn; [apply update_fits; auto|].
    intros m here. apply in_app_or in here. destruct here as [here|[<-|[]]]; [now apply nf|].
    cbn. now apply filter_fits.
  - destruct (nth_error _ _); [now apply hear_fits|exact wf].
  - destruct (nth_error _ _); [now apply hear_fits|exact wf].
  - now apply hear_fits.
  - pose proof (rf r) as [bf gf]. split; cbn; [|intros m'; rewrite app_nil_r; apply nf].
    apply update_fits; [exact rf|]. split; cbn; [exact bf|].
    destruct (guard (robots w r)) as [g|]; [|exact I]. destruct gf as [pf below].
    split; cbn; [exact pf|]. unfold earn. lia.
  - destruct (_ <=? _); [|exact wf]. pose proof (rf r) as [bf gf].
    split; cbn; [|intros m'; rewrite app_nil_r; apply nf]. apply update_fits; [exact rf|now split].
  - destruct (resume _ _ _) as [c|]; [|exact wf]. split; cbn; [|exact nf].
    apply update_fits; [exact rf|]. destruct rep as [bf pf]. split; cbn; [exact bf|].
    destruct (own_policy anew) as [p|]; [|exact I]. cbn. split; [exact pf|]. now destruct pf.
Qed.

Lemma init_fits : world_fits (init l).
Proof.
  split; [|intros m []]. intros r. destruct limits_ok as (_ & bf & _). now split.
Qed.

Lemma run_last commands c :
  run gene_clocks l (commands ++ [c]) = fst (step gene_clocks l (run gene_clocks l commands) c).
Proof. unfold run. now rewrite fold_left_app. Qed.

Lemma run_is commands : Forall representable commands ->
  shipped_run l commands = run gene_clocks l commands /\ world_fits (run gene_clocks l commands).
Proof.
  induction commands as [|c commands again] using rev_ind; intros rep.
  - split; [|apply init_fits]. unfold shipped_run, shipped_robot. cbn.
    now rewrite shipped_start_is.
  - apply Forall_app in rep. destruct rep as [rep rep_c]. inversion rep_c as [|? ? its _]; subst.
    destruct (again rep) as [same fit]. rewrite run_last. split; [|now apply step_fits].
    unfold shipped_run in *. rewrite fold_left_app. cbn. rewrite same, step_is; auto.
    now apply run_invariant.
Qed.
End World.

Theorem shipped_is_model : Shipped.shipped_is_model.
Proof. intros l commands (Valid & lf & rep). now apply run_is. Qed.

(** ** The claims *)

Theorem shipped_marks_unique : Shipped.shipped_marks_unique.
Proof.
  intros l commands e1 e2 gene given. rewrite shipped_is_model by exact given.
  apply marks_unique. now destruct given.
Qed.

Theorem shipped_clock_condition : Shipped.shipped_clock_condition.
Proof.
  intros l commands e1 e2 a b given. rewrite shipped_is_model by exact given.
  apply clock_condition. now destruct given.
Qed.

Theorem shipped_never_wraps : Shipped.shipped_never_wraps.
Proof.
  intros l commands r given. rewrite shipped_is_model by exact given.
  apply never_wraps. now destruct given.
Qed.

Theorem shipped_nothing_sent_is_forgotten : Shipped.shipped_nothing_sent_is_forgotten.
Proof.
  intros l commands e k given. rewrite shipped_is_model by exact given.
  apply nothing_sent_is_forgotten. now destruct given.
Qed.

Theorem shipped_restart_is_safe : Shipped.shipped_restart_is_safe.
Proof.
  intros l earlier r anew later e gene given.
  assert (before : told_to l (earlier ++ [Crash r anew])%list).
  { destruct given as (Valid & lf & rep). repeat split; try apply lf; auto.
    rewrite app_assoc in rep. now apply Forall_app in rep. }
  rewrite shipped_is_model, shipped_is_model by assumption.
  apply restart_is_safe. now destruct given.
Qed.

(** A swarm of the shipped functions in which much happens: marks are made, sent, received, and
    survive a crash. *)
Example shipped_witness :
  let l := Limits 20 3 10 2 in
  let commands := [Mint 7 2; Persist 7 8; Send 7 [Mark 3 7]; Receive 8 0; Mint 8 1;
                   Crash 7 (Settings 3 None); Mint 7 1] in
  told_to l commands /\
  memory (robots (shipped_run l commands) 7) = Clock 9 12
  /\ memory (robots (shipped_run l commands) 8) = Clock 6 8.
Proof.
  split; [|split; vm_compute; reflexivity].
  split; [reflexivity|]. split; [unfold limits_fit, fits; cbn; lia|].
  repeat apply Forall_cons; try apply Forall_nil; unfold representable, fits; cbn; lia.
Qed.

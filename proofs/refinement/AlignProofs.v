(** * Alignment refines the model *)
From Coq Require Import ZArith NArith String List Bool Lia.
From GeneClocks Require Import Mark Clock Alignment.
From Refinement Require Import Semantics Kernel Statements Execution.
Import ListNotations.
Open Scope list_scope.

Theorem gene_clocks_visit_refines : Statements.gene_clocks_visit_refines.
Proof.
  intros outside m visit which context match_ first second here known told. subst told.
  intros fuel _. enter. repeat step. returned.
Qed.

Section Alignment.
Context (outside : N -> list value -> memory -> memory) (m : memory)
  (first_at second_at visit : address) (first second : list mark) (which : N) (context : value).
Notation same_mark := (fun gene : mark => gene).

(** What the visitor is still told when [i] genes of the first and [j] of the second are done. *)
Definition ahead (i j : nat) : list (Z * nat * nat) :=
  visits (align same_mark (from i first) (from j second)) i j.

Lemma ahead_both i j a b : nth_error first i = Some a -> nth_error second j = Some b ->
  ahead i j = match mark_compare a b with
  | Eq => (gene_clocks_matching, i, j) :: ahead (S i) (S j)
  | Lt => (gene_clocks_disjoint_first, i, j) :: ahead (S i) j
  | Gt => (gene_clocks_disjoint_second, i, j) :: ahead i (S j)
  end.
Proof.
  intros here there. unfold ahead. rewrite (from_nth _ _ _ here), (from_nth _ _ _ there).
  cbn [align]. now destruct (mark_compare a b).
Qed.

Lemma ahead_first i j a : nth_error first i = Some a -> (length second <= j)%nat ->
  ahead i j = (gene_clocks_excess_first, i, j) :: ahead (S i) j.
Proof.
  intros here there. unfold ahead. rewrite (from_nth _ _ _ here), (from_end _ _ there).
  now destruct (from (S i) first).
Qed.

Lemma ahead_second i j b : (length first <= i)%nat -> nth_error second j = Some b ->
  ahead i j = (gene_clocks_excess_second, i, j) :: ahead i (S j).
Proof.
  intros here there. unfold ahead. rewrite (from_end _ _ here), (from_nth _ _ _ there).
  now destruct (from (S j) second).
Qed.

Lemma ahead_none i j : (length first <= i)%nat -> (length second <= j)%nat -> ahead i j = [].
Proof. intros here there. unfold ahead. now rewrite (from_end _ _ here), (from_end _ _ there). Qed.

(** What may be read during the alignment. *)
Definition at_hand (m : memory) : Prop :=
  (forall k gene, nth_error first k = Some gene ->
     m (offset first_at (Z.of_nat k)) = Some (mark_value gene))
  /\ (forall k gene, nth_error second k = Some gene ->
     m (offset second_at (Z.of_nat k)) = Some (mark_value gene))
  /\ m visit = Some (visitor_value which context).

Definition leaves_alone : Prop := forall arguments (m : memory) a,
  within first_at first a \/ within second_at second a \/ a = visit ->
  outside which arguments m a = m a.

Lemma still_at_hand m' arguments : leaves_alone -> at_hand m' -> at_hand (outside which arguments m').
Proof.
  intros alone (one & two & three). unfold at_hand.
  repeat split; intros; rewrite alone; auto; [left|right; left]; exists k;
    (split; [apply nth_error_Some; congruence|reflexivity]).
Qed.

Definition visited (told_so_far : list (list value)) (m : memory) : memory :=
  fold_left (fun m arguments => outside which arguments m) told_so_far m.

(** Between any two visits; [all] is what the visitor will have been told at the end. *)
Definition aligning (bound : nat -> nat -> Prop) (i_slot j_slot : nat) (env : locals)
    (all : list (list value)) (n : nat) (env' : locals) (s' : state) : Prop :=
  exists i j m' so_far, (i <= length first)%nat /\ (j <= length second)%nat /\ bound i j
    /\ n = (length first + length second - i - j)%nat
    /\ env' = with_slots env [(i_slot, Int (Z.of_nat i)); (j_slot, Int (Z.of_nat j))]
    /\ s' = State m' (map (fun arguments => (which, arguments)) so_far)
    /\ at_hand m' /\ m' = visited so_far m
    /\ so_far ++ map (told context) (ahead i j) = all.
End Alignment.

Global Opaque ahead.

Ltac find_gene genome k :=
  lazymatch goal with
  | _ : nth_error genome k = _ |- _ => fail
  | _ => let found := fresh "found" in
         destruct (nth_error genome k) as [[? ?]|] eqn:found;
         [|exfalso; apply nth_error_None in found; lia]
  end.

Ltac look_ahead :=
  match goal with
  | here : nth_error ?f ?i = Some _, there : nth_error ?s ?j = Some _ |- context [ahead ?f ?s ?i ?j] =>
      rewrite (ahead_both f s i j _ _ here there); unfold mark_compare; cbn [counter maker]
  | here : nth_error ?f ?i = Some _ |- context [ahead ?f ?s ?i ?j] =>
      rewrite (ahead_first f s i j _ here) by lia
  | there : nth_error ?s ?j = Some _ |- context [ahead ?f ?s ?i ?j] =>
      rewrite (ahead_second f s i j _) by (lia || exact there)
  | |- context [ahead ?f ?s ?i ?j] => rewrite (ahead_none f s i j) by lia
  | |- context [ahead ?f _ ?i _] => find_gene f i
  | |- context [ahead _ ?s _ ?j] => find_gene s j
  end.


Lemma map_last {A B} (f : A -> B) l x y : f x = y -> map f l ++ [y] = map f (l ++ [x]).
Proof. intros <-. now rewrite map_app. Qed.
Lemma visited_last outside which so_far m m' last :
  m' = visited outside which so_far m ->
  outside which last m' = visited outside which (so_far ++ [last]) m.
Proof. intros ->. unfold visited. now rewrite fold_left_app. Qed.

(** One visit brings the loop from one state between visits to the next. *)
Ltac next_visit alone more_i more_j :=
  match goal with
  | hand : at_hand _ _ _ _ _ _ _ ?m', memory_is : ?m' = _,
    all : _ ++ map (told _) (ahead _ _ ?i ?j) = _ |- _ =>
      eexists; split;
      [|exists (more_i + i)%nat, (more_j + j)%nat; do 2 eexists;
        split; [lia|]; split; [lia|]; split; [lia|]; split; [reflexivity|];
        split; [cbn; same|]; split; [f_equal; apply map_last; reflexivity|];
        split; [apply (still_at_hand _ _ _ _ _ _ _ _ _ _ alone hand)|];
        split; [apply (visited_last _ _ _ _ _ _ memory_is)|];
        rewrite <- all, <- app_assoc; cbn -[from]; f_equal;
        repeat (look_ahead; repeat step); reflexivity];
      cbn; lia
  end.

(** A loop of visits, whose variables for the two genomes are in these slots; [bound] holds before
    each, and [after] is what to do where the loop ends. *)
Ltac visiting alone bound i_slot j_slot after :=
  match goal with
  | hand : at_hand ?first_at ?second_at ?visit ?first ?second ?which ?context ?m',
    memory_is : ?m' = visited ?outside _ ?so_far ?m,
    all : ?so_far ++ map (told _) (ahead _ _ ?i ?j) = ?calls
    |- context [iterate _ _ ?env _] =>
      at_loop (aligning outside m first_at second_at visit first second which context
                 bound i_slot j_slot env calls) (length first + length second - i - j)%nat;
      [ clear all hand memory_is;
        let i := fresh "i" in let j := fresh "j" in let m' := fresh "m" in
        let so_far := fresh "so_far" in let bounded := fresh "bounded" in
        let hand := fresh "hand" in let memory_is := fresh "memory_is" in
        let here1 := fresh "here" in let here2 := fresh "here" in let here3 := fresh "here" in
        let all := fresh "all" in
        intros ? ? ? (i & j & m' & so_far & ? & ? & bounded & -> & -> & -> & hand & memory_is & all);
        pose proof hand as (here1 & here2 & here3); cbn beta in bounded; compute_on; repeat step;
        first [ next_visit alone 1%nat 1%nat | next_visit alone 1%nat 0%nat
              | next_visit alone 0%nat 1%nat | after tt ]
      | exists i, j, m', so_far; split; [lia|]; split; [lia|]; split; [cbn beta; lia|];
        split; [reflexivity|]; split; [cbn; same|]; split; [reflexivity|]; auto
      | lia ]
  end.

Ltac all_visited := idtac;
  match goal with
  | all : ?so_far ++ map (told _) (ahead _ _ ?i ?j) = _, memory_is : ?m' = _ |- _ =>
      rewrite ahead_none in all by lia; cbn in all; rewrite app_nil_r in all; subst so_far;
      exists m'; split; [reflexivity|intros; now rewrite memory_is]
  end.

Ltac aligning_in alone first second i_slot j_slot :=
  visiting alone (fun _ _ : nat => True) i_slot j_slot ltac:(fun _ =>
  visiting alone (fun i j => length first <= i \/ length second <= j)%nat i_slot j_slot ltac:(fun _ =>
  visiting alone (fun i j : nat => length first <= i)%nat i_slot j_slot ltac:(fun _ => all_visited))).

Theorem gene_clocks_align_refines : Statements.gene_clocks_align_refines.
Proof.
  intros outside m first_at second_at first second visit which context [fit1 here1] [fit2 here2]
    here3 known alone calls.
  assert (hand : at_hand first_at second_at visit first second which context m)
    by now unfold at_hand.
  change (leaves_alone outside first_at second_at visit first second which) in alone.
  assert (all : [] ++ map (told context) (ahead first second 0 0) = calls) by reflexivity.
  assert (memory_is : m = visited outside which [] m) by reflexivity.
  clear here1 here2 here3. clearbody calls. unfold size_value. open_numbers.
  intros fuel enough. enter. repeat step.
  let slots := eval compute in (loop_slots gene_clocks_align) in
  lazymatch slots with
  | [?a; ?b] => first [aligning_in alone first second a b | aligning_in alone first second b a]
  end.
Qed.

(** * Symbolic execution

    The tactics run a function on unknown values: they compute as far as they can, and where the
    way depends on a comparison they go both ways and drop the way that arithmetic excludes. They
    know the semantics, and nothing of the text that is run. *)
From Coq Require Import ZArith NArith String List Bool Lia.
From GeneClocks Require Import Mark Clock.
From Refinement Require Import Semantics Kernel Statements.
Import ListNotations.

(** ** Memory *)

Lemma same_address_spec a b : reflect (a = b) (same_address a b).
Proof.
  destruct a as [b1 i1], b as [b2 i2]. unfold same_address. cbn.
  destruct (N.eqb_spec b1 b2), (Z.eqb_spec i1 i2); cbn; constructor; congruence.
Qed.

Lemma write_same m a v : write m a v a = Some v.
Proof. unfold write. now destruct (same_address_spec a a). Qed.

Lemma write_other m a v a' : a <> a' -> write m a v a' = m a'.
Proof. intros. unfold write. now destruct (same_address_spec a a'). Qed.

(** ** Loops *)

(** What holds after a loop, [G], if [I] holds of every round with a number that falls. *)
Lemma loop_rule (I : nat -> locals -> state -> Prop) (G : option (outcome * locals * state) -> Prop)
    round :
  (forall n env s, I n env s ->
     match round env s with
     | Some (Again env' s') => exists n', (n' < n)%nat /\ I n' env' s'
     | Some (Done o env' s') => G (Some (o, env', s'))
     | None => False
     end) ->
  forall n env s rounds, I n env s -> (n < rounds)%nat -> G (iterate rounds round env s).
Proof.
  intros round_holds n env s rounds. revert n env s.
  induction rounds as [|rounds again]; intros n env s holds enough; [lia|]. cbn.
  specialize (round_holds n env s holds).
  destruct (round env s) as [[env' s'|o env' s']|]; [|assumption|contradiction].
  destruct round_holds as (n' & less & holds'). apply (again n'); [assumption|lia].
Qed.

(** The rest of a list, at an index. *)
Definition from {A} (k : nat) (l : list A) : list A := skipn k l.

(** ** Comparisons *)

Lemma nonzero_spec z : reflect (z <> 0%Z) (nonzero z).
Proof. destruct z; cbn; constructor; congruence. Qed.

(** Goes both ways at a condition that something waits for. *)
Ltac fork b :=
  match b with
  | negb ?c => fork c
  | ?c && ?d => fork c
  | ?c || ?d => fork c
  | Z.ltb ?x ?y => destruct (Z.ltb_spec x y); try (exfalso; lia)
  | Z.leb ?x ?y => destruct (Z.leb_spec x y); try (exfalso; lia)
  | Z.eqb ?x ?y => destruct (Z.eqb_spec x y); try (exfalso; lia)
  | N.ltb ?x ?y => destruct (N.ltb_spec x y); try (exfalso; lia)
  | N.leb ?x ?y => destruct (N.leb_spec x y); try (exfalso; lia)
  | N.eqb ?x ?y => destruct (N.eqb_spec x y); try (exfalso; lia)
  | nonzero (of_bool ?c) => fork c
  | nonzero ?z => destruct (nonzero_spec z); try (exfalso; lia)
  end.

(** Unsigned arithmetic that does not wrap, or wraps once. *)
Lemma wraps_below z m : (- m <= z < 0 -> z mod m = z + m)%Z.
Proof. intros. symmetry. apply (Z.mod_unique z m (-1)); lia. Qed.
Lemma wraps_above z m : (m <= z < m + m -> z mod m = z - m)%Z.
Proof. intros. symmetry. apply (Z.mod_unique z m 1); lia. Qed.

Ltac wrapped z m :=
  first
    [ rewrite (Z.mod_small z m) by lia
    | rewrite (wraps_below z m) by lia
    | rewrite (wraps_above z m) by lia
    | destruct (Z.ltb_spec z 0);
      [rewrite (wraps_below z m) by lia|rewrite (Z.mod_small z m) by lia]
    | destruct (Z.ltb_spec z m);
      [rewrite (Z.mod_small z m) by lia|rewrite (wraps_above z m) by lia] ].

Ltac compute_on :=
  cbn -[Z.add Z.sub Z.opp Z.mul Z.modulo Z.ltb Z.leb Z.eqb Z.quot Z.rem Z.land Z.lor Z.lxor
        Z.shiftl Z.shiftr Z.lnot Z.of_N Z.of_nat N.ltb N.leb N.eqb N.add N.sub N.min N.max
        write offset iterate greatest from].

Lemma defined_known v : v <> Undefined -> defined v = Some v.
Proof. now destruct v. Qed.

(** The gene at an index that lies in its genome. *)
Ltac look_up_gene :=
  match goal with
  | here : forall k gene, nth_error ?genome k = Some gene -> ?m (offset ?a (Z.of_nat k)) = _
    |- context [?m (offset ?a (Z.of_nat ?k))] =>
      match goal with
      | found : nth_error genome k = Some _ |- _ => rewrite (here _ _ found)
      | _ =>
          let c := fresh "c" in let r := fresh "r" in let found := fresh "found" in
          destruct (nth_error genome k) as [[c r]|] eqn:found;
          [rewrite (here _ _ found)|exfalso; apply nth_error_None in found; lia]
      end
  end.

Ltac look_up :=
  match goal with
  | |- _ => look_up_gene
  | |- context [write _ ?a _ ?a] => rewrite (write_same _ a)
  | |- context [write ?m ?a ?v ?b] => rewrite (write_other m a v b) by congruence
  | found : ?m ?a = Some _ |- context [?m ?a] => rewrite found
  | known : ?v <> Undefined |- context [defined ?v] => rewrite (defined_known v known)
  end.

(** A condition that speaks of wrapped numbers, or itself has conditions, waits until these are
    known. *)
Ltac decided b :=
  lazymatch b with
  | context [Z.modulo] => fail
  | context [if _ then _ else _] => fail
  | _ => fork b
  end.

Ltac step :=
  first
    [ look_up
    | match goal with
      | |- context [of_bool ?b] => decided b
      | |- context [if ?b then _ else _] => decided b
      | |- context [?b && _] => decided b
      | |- context [?b || _] => decided b
      | |- context [nonzero ?z] => decided (nonzero z)
      | |- context [N.compare ?x ?y] => destruct (N.compare_spec x y); try (exfalso; lia)
      | |- context [(?z mod ?m)%Z] => wrapped z m
      end ];
  compute_on.

Ltac open_numbers :=
  unfold clock_at, clock_fits, limits_fit, fits, gene_clocks_counter, size_t in *;
  repeat match goal with
  | h : _ /\ _ |- _ => destruct h
  | c : clock |- _ => destruct c
  | l : limits |- _ => destruct l
  | m : mark |- _ => destruct m
  end;
  cbn [greatest next durable maximum block window genesis_count counter maker] in *.

(** ** At the end *)

(** Two values, or two memories at one address, that differ in how a number is written at most. *)
Ltac same :=
  first [ reflexivity | lia | congruence
        | progress unfold number_value, bool_value, clock_value, limits_value, mark_value, size_value in *;
          cbn [next durable maximum block window counter maker] in *; same
        | progress f_equal; same ].

Ltac same_memory :=
  let a := fresh "a" in
  intros a; unfold write;
  repeat match goal with
  | |- context [same_address ?x ?y] => destruct (same_address_spec x y); subst; try contradiction
  end;
  repeat match goal with found : ?m ?a = Some _ |- context [?m ?a] => rewrite found end;
  same.

Ltac returned := eexists; split; [same|same_memory].

(** Starts a function; then [step]s until it has returned. *)
Ltac enter := unfold kernel; compute_on.

(** *** Loops *)

Lemma from_nth {A} (l : list A) : forall k x, nth_error l k = Some x -> from k l = x :: from (S k) l.
Proof.
  unfold from. induction l as [|y l again]; intros [|k] x found; cbn in *; try discriminate;
    [congruence|]. now apply again.
Qed.
Lemma from_end {A} (l : list A) k : (length l <= k)%nat -> from k l = [].
Proof. intros. now apply skipn_all2. Qed.

(** What is left of a list at an index. *)
Ltac advance :=
  repeat match goal with
  | found : nth_error ?l ?k = Some _, h : context [from ?k ?l] |- _ =>
      rewrite (from_nth l k _ found) in h
  | h : context [from ?k ?l] |- _ => rewrite (from_end l k) in h by lia
  end.

Fixpoint with_slots (env : locals) (slots : list (nat * value)) : locals :=
  match slots with
  | [] => env
  | (i, v) :: rest => with_slots (app (firstn i env) (v :: skipn (S i) env)) rest
  end.

(** The variables that the loops of a function change. *)
Fixpoint assigned (c : statement) : list nat :=
  match c with
  | Assign slot _ _ => [slot]
  | Sequence a b | If _ a b | Loop _ a b => app (assigned a) (assigned b)
  | Scope c => assigned c
  | _ => []
  end.
Fixpoint looped (c : statement) : list nat :=
  match c with
  | Sequence a b | If _ a b => app (looped a) (looped b)
  | Scope c => looped c
  | Loop _ a b => app (assigned a) (assigned b)
  | _ => []
  end.
Fixpoint sorted_slots (bound : nat) (slots : list nat) : list nat :=
  match bound with
  | O => []
  | S bound => app (sorted_slots bound slots) (if existsb (Nat.eqb bound) slots then [bound] else [])
  end.
Definition loop_slots (f : function) : list nat := sorted_slots 20 (looped (body f)).

(** Takes the next loop with the invariant [I] and the number of rounds [n]. *)
Ltac at_loop I n :=
  match goal with
  | |- context [iterate ?fuel ?round ?env ?s] =>
      pattern (iterate fuel round env s);
      match goal with
      | |- ?G _ => refine (loop_rule I G round _ n env s fuel _ _)
      end
  end.

(** All of a function without loops. *)
Ltac run_to_the_end :=
  let outside := fresh "outside" in let fuel := fresh "fuel" in
  intros outside fuel _; enter; repeat step; returned.

(** Where the model's answer decides what is claimed, the function still runs only once. *)
Lemma answered {A} (answer : option A) f arguments m result m' result' m'' :
  computes f arguments m
    (match answer with Some x => result x | None => result' end)
    (match answer with Some x => m' x | None => m'' end) ->
  match answer with
  | Some x => computes f arguments m (result x) (m' x)
  | None => computes f arguments m result' m''
  end.
Proof. now destruct answer. Qed.

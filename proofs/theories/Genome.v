(** * Genomes: odNEAT's operators over the protocol

    What the operators do to marks. Structure and weights are in here only as far as they decide
    which gene goes where: a gene may be anything that has a mark. *)
From Coq Require Import NArith QArith List Bool.
From GeneClocks Require Import Mark Alignment Clock Admission Protocol.
Import ListNotations.
Open Scope N_scope.

(** ** Crossover and distance, as in [neat/] *)

Section Crossover.
Context {gene draws : Type} (mark_of : gene -> mark)
  (choose : draws -> gene -> gene -> gene * draws)  (** which copy of a matching gene, by chance *)
  (keep : list gene -> gene -> bool).               (** given what the child has, may this join? *)

Definition join (child : list gene) (a : gene) : list gene :=
  if keep child a then child ++ [a] else child.

Fixpoint inherit (d : draws) (child : list gene) (alignment : list (aligned gene))
  : list gene * draws :=
  match alignment with
  | [] => (child, d)
  | Matching a b :: rest => let (chosen, d) := choose d a b in inherit d (join child chosen) rest
  | Disjoint First a :: rest | Excess First a :: rest => inherit d (join child a) rest
  | Disjoint Second _ :: rest | Excess Second _ :: rest => inherit d child rest
  end.

(** Matching genes from either parent, disjoint and excess ones from the fitter; also returns
    what is left of the draws. *)
Definition crossover (d : draws) (fitter weaker : list gene) : list gene * draws :=
  inherit d [] (align mark_of fitter weaker).

(** Equation 1; [size] is its N, and [difference] the mean or sum of weight differences. *)
Definition distance (c1 c2 c3 : Q) (size : positive) (difference : list (gene * gene) -> Q)
    (a b : list gene) : Q :=
  let alignment := align mark_of a b in
  (c1 * (Z.of_nat (excess_count alignment) # size)
   + c2 * (Z.of_nat (disjoint_count alignment) # size)
   + c3 * difference (matches alignment))%Q.
End Crossover.

(** ** What odNEAT decides by

    The choices of [neat/src/crossover.cpp] and the weights of [neat/src/distance.cpp]; everything
    above holds for any others. *)

Record connection := Connection {
  innovation : mark;
  source : mark;  (** the neurons that it joins *)
  target : mark;
  recurrent : bool;
  weight : Z;     (** in any unit *)
  enabled : bool
}.

(** The fitter of two parents; at equal fitness the smaller, then the second. *)
Definition is_first_fitter (fitness1 fitness2 : Z) (size1 size2 : nat) : bool :=
  if (fitness1 =? fitness2)%Z then (size1 <? size2)%nat else (fitness2 <? fitness1)%Z.

Definition reweighted (a : connection) (w : Z) (on : bool) : connection :=
  Connection (innovation a) (source a) (target a) (recurrent a) w on.

(** Uniform crossover. A draw is a number from [0, 1), of which only two things matter: whether it
    lies below one half, and below the probability to disable. *)
Definition draw : list (bool * bool) -> (bool * bool) * list (bool * bool) :=
  fun draws => match draws with d :: rest => (d, rest) | [] => ((false, false), []) end.
Definition choose_uniformly (draws : list (bool * bool)) (a b : connection)
  : connection * list (bool * bool) :=
  let '((from_other, _), draws) := draw draws in
  let w := if from_other then weight b else weight a in
  if xorb (enabled a) (enabled b)
  then let '((_, disable), draws) := draw draws in (reweighted a w (negb disable), draws)
  else (reweighted a w (enabled a), draws).

(** Crossover at one point: which of the matching genes, oldest first, come from the other. *)
Definition choose_listed (from_other : list bool) (a b : connection) : connection * list bool :=
  match from_other with
  | true :: rest => (reweighted a (weight b) (enabled b), rest)
  | false :: rest => (a, rest)
  | [] => (a, [])
  end.

(** No connection joins the child that reverses a feed-forward one of it. *)
Definition reverses_none (child : list connection) (a : connection) : bool :=
  negb (existsb (fun c => negb (recurrent c) && mark_eqb (source c) (target a)
                          && mark_eqb (target c) (source a)) child).

(** The differences of weights that count are those of genes enabled in both; their sum, or their
    mean. Weights are in units of 1/[unit]. *)
Definition both_enabled (pair : connection * connection) : bool :=
  enabled (fst pair) && enabled (snd pair).
Definition differences (pairs : list (connection * connection)) : Z :=
  fold_right (fun pair sum => Z.abs (weight (fst pair) - weight (snd pair)) + sum)%Z 0%Z
    (filter both_enabled pairs).
Definition weight_sum (unit : positive) (pairs : list (connection * connection)) : Q :=
  differences pairs # unit.
Definition weight_mean (unit : positive) (pairs : list (connection * connection)) : Q :=
  differences pairs # (unit * Pos.max 1 (Pos.of_nat (length (filter both_enabled pairs)))).

(** ** A swarm: robots that hold genomes

    A genome is its list of marks. Weight mutation and cloning change no marks. Forgetting a genome
    needs no operation: whatever is proved of all genomes that a robot has held is proved of those
    that it kept. *)

Definition genome := list mark.

Record swarm := Swarm { world_of : world; held : N -> list genome }.

Inductive operation :=
| AddGenes (r : N) (parent : nat) (count : N)     (** add-connection: 1; add-neuron: 3 *)
| Recombine (r : N) (fitter weaker : nat) (keep : genome -> mark -> bool)
| Broadcast (r : N) (sent : nat)
| Deliver (r : N) (message : nat)
| Listen (r : N) (message : nat)                 (** takes a message's stamp alone *)
| Wait (r : N)                                    (** a cycle of its gate's time *)
| Store (r value : N)
| Fail (r : N) (anew : settings).

Section Operate.
Context (l : limits).

Definition hold (held : N -> list genome) (r : N) (g : genome) : N -> list genome :=
  fun r' => if r' =? r then held r ++ [g] else held r'.

Definition operate (s : swarm) (o : operation) : swarm :=
  let w := world_of s in
  let do := step gene_clocks l w in
  match o with
  | AddGenes r i count =>
      match nth_error (held s r) i, do (Mint r count) with
      | Some parent, (w', Marks first _) =>
          Swarm w' (hold (held s) r (parent ++ minted_marks r first (N.to_nat count)))
      | _, _ => s
      end
  | Recombine r i j keep =>
      match nth_error (held s r) i, nth_error (held s r) j with
      | Some fitter, Some weaker =>
          let copy (d : unit) (a b : mark) := (a, d) in
          Swarm w (hold (held s) r (fst (crossover id copy keep tt fitter weaker)))
      | _, _ => s
      end
  | Broadcast r i =>
      match nth_error (held s r) i with
      | Some g => Swarm (fst (do (Send r g))) (held s)
      | None => s
      end
  | Deliver r k =>
      match nth_error (network w) k, do (Receive r k) with
      | Some m, (w', Accepted) => Swarm w' (hold (held s) r (genes m))
      | _, _ => s
      end
  | Listen r k => Swarm (fst (do (Overhear r k))) (held s)
  | Wait r => Swarm (fst (do (Elapse r))) (held s)
  | Store r value => Swarm (fst (do (Persist r value))) (held s)
  | Fail r anew =>
      let survives (g : genome) := forallb (retains gene_clocks (stored (robots w r))) g in
      Swarm (fst (do (Crash r anew)))
            (fun r' => if r' =? r then filter survives (held s r) else held s r')
  end.

(** Every robot begins with the initial genome. *)
Definition swarm_init : swarm := Swarm (init l) (fun _ => [genesis l]).

Definition evolve (operations : list operation) : swarm :=
  fold_left operate operations swarm_init.
End Operate.

(** A genome of the swarm: held by a robot, or in a message. *)
Definition in_swarm (s : swarm) (g : genome) : Prop :=
  (exists r, In g (held s r)) \/ (exists m, In m (network (world_of s)) /\ genes m = g).

(** ** The order of creation *)

Definition is_genesis (l : limits) (gene : mark) : Prop := In gene (genesis l).

(** The initial genes are there before all others, in the order that all robots share. *)
Definition created_before (l : limits) (w : world) (a b : mark) : Prop :=
  (is_genesis l a /\ is_genesis l b /\ counter a < counter b)
  \/ (is_genesis l a /\ exists e, makes w e b)
  \/ (exists ea eb, makes w ea a /\ makes w eb b /\ happened_before (history w) ea eb).

(** ** Other markings

    Gene-clock marks are unique, so they name the genes, and any other way to mark the same genes
    is a function of them: timestamps of synchronised clocks, say. *)
Definition respects_creation (l : limits) (w : world) (other : mark -> mark) : Prop :=
  forall a b, created_before l w a b -> other a << other b.

Definition exists_in (l : limits) (w : world) (gene : mark) : Prop :=
  is_genesis l gene \/ exists e, makes w e gene.

Definition one_to_one (l : limits) (w : world) (other : mark -> mark) : Prop :=
  forall a b, exists_in l w a -> exists_in l w b -> other a = other b -> a = b.

(** * The contracts of kernel.h

    Made by acsl_to_coq from the header; do not edit. *)
From Coq Require Import ZArith NArith List.
From Refinement Require Import Kernel.
From GeneClocks Require Import Mark Clock.
Open Scope N_scope.

Definition gene (genome : list mark) (index : N) : mark :=
  nth (N.to_nat index) genome (Mark 0 0).

Definition below (a : mark) (b : mark) : Prop :=
  (((counter a) < (counter b)) \/ (((counter a) = (counter b)) /\ ((maker a) < (maker b)))).

Definition same (a : mark) (b : mark) : Prop :=
  (((counter a) = (counter b)) /\ ((maker a) = (maker b))).

Definition usable (l : limits) (next0 durable0 : N) : Prop :=
  (((True /\ True) /\ True) /\ (((1 <= next0) /\ (next0 <= durable0)) /\ (durable0 <= (maximum l)))).

Definition reserved (l : limits) (next : N) (durable : N) : N :=
  (if next <=? durable then durable else (N.min (next + (block l)) (maximum l))).

Definition unmade (mark : mark) (next : N) (robot : N) : Prop :=
  (((maker mark) = robot) /\ ((counter mark) >= next)).

Definition less_requires (l : limits) (a : mark) (b : mark) : Prop :=
  True.
Definition less_contract (l : limits) (a : mark) (b : mark) (result : bool) : Prop :=
  ((result = true) <-> (below a b)).

Definition equal_requires (l : limits) (a : mark) (b : mark) : Prop :=
  True.
Definition equal_contract (l : limits) (a : mark) (b : mark) (result : bool) : Prop :=
  ((result = true) <-> (same a b)).

Definition restore_requires (l : limits) (next0 durable0 : N) (next : N) (durable : N) : Prop :=
  ((True /\ True) /\ True).
Definition restore_contract (l : limits) (next0 durable0 : N) (next : N) (durable : N) (result : bool) (next0' durable0' : N) : Prop :=
  ((result = true) <-> (((1 <= next) /\ (next <= durable)) /\ (durable <= (maximum l))))
  /\ ((result = true) -> (((usable l next0' durable0') /\ (next0' = next)) /\ (durable0' = durable)))
  /\ ((~ (result = true)) -> (next0' = next0 /\ durable0' = durable0)).

Definition start_requires (l : limits) (next0 durable0 : N) (genesis_count : N) : Prop :=
  ((True /\ True) /\ True).
Definition start_contract (l : limits) (next0 durable0 : N) (genesis_count : N) (result : bool) (next0' durable0' : N) : Prop :=
  ((result = true) <-> (genesis_count < (maximum l)))
  /\ ((result = true) -> ((usable l next0' durable0') /\ ((next0' = durable0') /\ (durable0' = (genesis_count + 1)))))
  /\ ((~ (result = true)) -> (next0' = next0 /\ durable0' = durable0)).

Definition restart_requires (l : limits) (next0 durable0 : N) (genesis_count : N) (stored : N) : Prop :=
  ((True /\ True) /\ True).
Definition restart_contract (l : limits) (next0 durable0 : N) (genesis_count : N) (stored : N) (result : bool) (next0' durable0' : N) : Prop :=
  ((result = true) <-> ((genesis_count < stored) /\ (stored <= (maximum l))))
  /\ ((result = true) -> ((usable l next0' durable0') /\ ((next0' = durable0') /\ (durable0' = stored))))
  /\ ((~ (result = true)) -> (next0' = next0 /\ durable0' = durable0)).

Definition reserve_requires (l : limits) (next0 durable0 : N) : Prop :=
  ((True /\ True) /\ True) /\ (next0 <= (maximum l)).
Definition reserve_contract (l : limits) (next0 durable0 : N) (next0' durable0' : N) : Prop :=
  next0' = next0
  /\ (durable0' = (reserved l next0' durable0)).

Definition mint_requires (l : limits) (next0 durable0 first0 : N) (count : N) : Prop :=
  ((usable l next0 durable0) /\ True) /\ (True /\ True).
Definition mint_contract (l : limits) (next0 durable0 first0 : N) (count : N) (result : bool) (next0' durable0' first0' : N) : Prop :=
  (usable l next0' durable0')
  /\ (((next0 + count) <= (maximum l)) ->
     ((result = true) /\ (first0' = next0)) /\ (next0' = (next0 + count)) /\ (durable0' = (reserved l next0' durable0)))
  /\ (((next0 + count) > (maximum l)) ->
     next0' = next0 /\ durable0' = durable0 /\ first0' = first0 /\ (~ (result = true))).

Definition observe_requires (l : limits) (next0 durable0 : N) (stamp : N) : Prop :=
  (usable l next0 durable0).
Definition observe_contract (l : limits) (next0 durable0 : N) (stamp : N) (result : bool) (next0' durable0' : N) : Prop :=
  (usable l next0' durable0')
  /\ (((stamp <= (maximum l)) /\ (stamp <= (next0 + (window l)))) ->
     ((result = true) /\ (next0' = (N.max next0 stamp))) /\ (durable0' = (reserved l next0' durable0)))
  /\ (((stamp > (maximum l)) \/ (stamp > (next0 + (window l)))) ->
     next0' = next0 /\ durable0' = durable0 /\ (~ (result = true))).

Definition covers_requires (l : limits) (stamp : N) (genome : list mark) (size : N) : Prop :=
  (N.of_nat (length genome) = size).
Definition covers_contract (l : limits) (stamp : N) (genome : list mark) (size : N) (result : bool) : Prop :=
  ((result = true) <-> (forall k : N, (((0 <= k) /\ (k < size)) -> ((counter (gene genome k)) < stamp)))).

Definition find_unmade_requires (l : limits) (next : N) (robot : N) (genome : list mark) (size : N) : Prop :=
  (N.of_nat (length genome) = size).
Definition find_unmade_contract (l : limits) (next : N) (robot : N) (genome : list mark) (size : N) (result : N) : Prop :=
  ((0 <= result) /\ (result <= size))
  /\ (forall k : N, (((0 <= k) /\ (k < result)) -> (~ (unmade (gene genome k) next robot))))
  /\ ((result < size) -> (unmade (gene genome result) next robot)).

Definition earn_requires (l : limits) (allowance0 : N) (counters : N) (ceiling : N) : Prop :=
  (True /\ (allowance0 <= ceiling)).
Definition earn_contract (l : limits) (allowance0 : N) (counters : N) (ceiling : N) (allowance0' : N) : Prop :=
  (allowance0' = (N.min (allowance0 + counters) ceiling)).

Definition admit_requires (l : limits) (next0 durable0 allowance0 : N) (stamp : N) : Prop :=
  ((usable l next0 durable0) /\ True) /\ True.
Definition admit_contract (l : limits) (next0 durable0 allowance0 : N) (stamp : N) (result : Z) (next0' durable0' allowance0' : N) : Prop :=
  (usable l next0' durable0')
  /\ ((stamp > (maximum l)) ->
     next0' = next0 /\ durable0' = durable0 /\ allowance0' = allowance0 /\ (result = gene_clocks_beyond_maximum)%Z)
  /\ (((stamp <= (maximum l)) /\ (stamp > (next0 + (window l)))) ->
     next0' = next0 /\ durable0' = durable0 /\ allowance0' = allowance0 /\ (result = gene_clocks_beyond_window)%Z)
  /\ (((stamp <= (maximum l)) /\ (stamp <= (next0 + (window l)))) /\ (stamp > (next0 + allowance0)) ->
     next0' = next0 /\ durable0' = durable0 /\ allowance0' = allowance0 /\ (result = gene_clocks_beyond_allowance)%Z)
  /\ (((stamp <= (maximum l)) /\ (stamp <= (next0 + (window l)))) /\ (stamp <= (next0 + allowance0)) ->
     (result = gene_clocks_admitted)%Z /\ (next0' = (N.max next0 stamp)) /\ (durable0' = (reserved l next0' durable0)) /\ ((next0' + allowance0') = (next0 + allowance0))).


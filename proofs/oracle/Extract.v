(** The proved functions as OCaml. Only booleans, options, lists and pairs become OCaml's own;
    numbers stay the inductive ones that the theorems are about. *)
From Coq Require Import Extraction ExtrOcamlBasic QArith.
From GeneClocks Require Import Mark Alignment Clock Protocol Genome.
From GeneClocks Require Trace Wire.

Extraction Language OCaml.
Extraction "proved.ml" align step gene_clocks init Trace.check_entry Trace.check_init
  Wire.decode Wire.encode
  is_first_fitter crossover choose_uniformly choose_listed reverses_none
  distance weight_sum weight_mean excess_count disjoint_count matches Qred operate swarm_init.

(** The proved functions as OCaml. Only booleans, options, lists and pairs become OCaml's own;
    numbers stay the inductive ones that the theorems are about. *)
From Coq Require Import Extraction ExtrOcamlBasic.
From GeneClocks Require Import Mark Alignment Clock Protocol.
From GeneClocks Require Trace Wire.

Extraction Language OCaml.
Extraction "proved.ml" align step gene_clocks init Trace.check_entry Trace.check_init
  Wire.decode Wire.encode.

(** The interpreter that is compared with compilers, extracted as it is: Coq's own numbers. *)
From Coq Require Import ZArith String List.
From Coq Require Import Extraction ExtrOcamlNativeString.
From Refinement Require Import Semantics.
From Compared Require Import Operators.
Extraction Language OCaml.
Extraction "interpreter.ml" run kernel Z.add Z.mul Z.opp Z.quot Z.rem Z.leb.

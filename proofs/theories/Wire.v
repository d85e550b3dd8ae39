(** * The wire format, version 1

    Mirrors [docs/wire-format.md] and [protocol/include/gene_clocks/wire.h] and [genome_payload.h].
    Bytes are numbers below 256; floats are the numbers that their bits are. A decoder takes what
    it can use off the front and returns the rest; [None] refuses. *)
From Coq Require Import NArith List Bool.
From GeneClocks Require Import Mark.
Import ListNotations.
Open Scope N_scope.

(** ** Messages *)

Inductive kind := Input | Bias | Output | Hidden.

Inductive body :=
| Neuron (k : kind)
| Connection (enabled recurrent : bool) (source target weight : N).

Record gene := Gene { mark_of : mark; body_of : body }.
Record genome := Genome { robot : N; birth : N; genes : list gene }.
Record message := Message { sender : N; stamp : N; energy : N; content : genome }.

Record limits := Limits {
  frame_bytes : N; genesis_count : N; neurons_max : N; connections_max : N;
  energy_max : N; weight_max : N }.

(** ** Numbers *)

Notation "'let*' x := a 'in' b" := (match a with Some x => b | None => None end)
  (at level 200, x pattern, a at level 100, b at level 200).
Notation "'guard' a 'in' b" := (if a then b else None) (at level 200, a at level 100, b at level 200).

Fixpoint put_varint (bytes : nat) (n : N) : list N :=
  match bytes with
  | O => []
  | S more => if n <? 128 then [n] else (128 + n mod 128) :: put_varint more (n / 128)
  end.

Fixpoint get_varint (bytes : nat) (input : list N) : option (N * list N) :=
  match bytes, input with
  | S more, b :: rest =>
      if b <? 128 then Some (b, rest) else
      guard b <? 256 in
      let* (n, rest') := get_varint more rest in
      guard negb (n =? 0) in Some (b - 128 + 128 * n, rest')
  | _, _ => None
  end.

(** At most ten bytes hold 64 bits; what is below [bound] may be told by fewer. *)
Definition get_number (bound : N) (input : list N) : option (N * list N) :=
  let* (n, rest) := get_varint 10 input in guard n <? bound in Some (n, rest).
Definition put_number : N -> list N := put_varint 10.

(** Little-endian, in as many bytes as said. *)
Fixpoint put_word (bytes : nat) (n : N) : list N :=
  match bytes with
  | O => []
  | S more => n mod 256 :: put_word more (n / 256)
  end.

Fixpoint get_word (bytes : nat) (input : list N) : option (N * list N) :=
  match bytes, input with
  | O, _ => Some (0, input)
  | S more, b :: rest =>
      guard b <? 256 in
      let* (n, rest') := get_word more rest in Some (b + 256 * n, rest')
  | S _, [] => None
  end.

(** Of a float's bits: finite, and in magnitude at most the one of these other bits. *)
Definition within (bits limit : N) : bool :=
  let magnitude := bits mod 2 ^ 31 in (magnitude <? 255 * 2 ^ 23) && (magnitude <=? limit).

(** ** The checksum: CRC-32C *)

Fixpoint crc_bits (count : nat) (crc : N) : N :=
  match count with
  | O => crc
  | S more => crc_bits more (if N.odd crc then N.lxor (N.div2 crc) 2197175160 else N.div2 crc)
  end.
Definition crc32c (input : list N) : N :=
  N.lxor (fold_left (fun crc b => crc_bits 8 (N.lxor crc b)) input (2 ^ 32 - 1)) (2 ^ 32 - 1)
    mod 2 ^ 32.

(** ** Genes *)

(** The low three bits of a gene's head. *)
Definition low_bits (b : body) : N :=
  match b with
  | Neuron Input => 0 | Neuron Bias => 2 | Neuron Output => 4 | Neuron Hidden => 6
  | Connection enabled recurrent _ _ _ => 1 + 2 * N.b2n enabled + 4 * N.b2n recurrent
  end.

Definition put_body (b : body) : list N :=
  match b with
  | Neuron _ => []
  | Connection _ _ source target weight =>
      put_number source ++ put_number target ++ put_word 4 weight
  end.

Definition get_body (low : N) (input : list N) : option (body * list N) :=
  match low with
  | 0 => Some (Neuron Input, input)
  | 2 => Some (Neuron Bias, input)
  | 4 => Some (Neuron Output, input)
  | 6 => Some (Neuron Hidden, input)
  | _ =>
      let* (source, rest) := get_number (2 ^ 16) input in
      let* (target, rest) := get_number (2 ^ 16) rest in
      let* (weight, rest) := get_word 4 rest in
      Some (Connection ((low =? 3) || (low =? 7)) ((low =? 5) || (low =? 7)) source target weight,
            rest)
  end.

(** A gene, after one with the mark [last]. *)
Definition put_gene (last : mark) (g : gene) : list N :=
  let leap := counter (mark_of g) - counter last in
  let is_far := 15 <=? leap in
  let is_other := negb (maker (mark_of g) =? maker last) in
  [16 * (if is_far then 15 else leap) + 8 * N.b2n is_other + low_bits (body_of g)]
  ++ (if is_far then put_number (leap - 15) else [])
  ++ (if is_other then put_number (maker (mark_of g)) else [])
  ++ put_body (body_of g).

Definition get_leap (nibble : N) (input : list N) : option (N * list N) :=
  if nibble =? 15 then
    let* (more, rest) := get_number (2 ^ 64) input in Some (15 + more, rest)
  else Some (nibble, input).

Definition get_maker (is_other : bool) (last : N) (input : list N) : option (N * list N) :=
  if is_other then
    let* (r, rest) := get_number (2 ^ 32) input in guard negb (r =? last) in Some (r, rest)
  else Some (last, input).

Definition get_gene (last : mark) (input : list N) : option (gene * list N) :=
  match input with
  | [] => None
  | head :: rest =>
      guard head <? 256 in
      let* (leap, rest) := get_leap (head / 16) rest in
      let* (r, rest) := get_maker (8 <=? head mod 16) (maker last) rest in
      let* (b, rest) := get_body (head mod 8) rest in
      Some (Gene (Mark (counter last + leap) r) b, rest)
  end.

Fixpoint put_genes (last : mark) (genes : list gene) : list N :=
  match genes with
  | [] => []
  | g :: others => put_gene last g ++ put_genes (mark_of g) others
  end.

Fixpoint get_genes (count : nat) (last : mark) (input : list N) : option (list gene * list N) :=
  match count with
  | O => Some ([], input)
  | S more =>
      let* (g, rest) := get_gene last input in
      let* (others, rest) := get_genes more (mark_of g) rest in Some (g :: others, rest)
  end.

Definition before_all : mark := Mark 0 0.

Definition is_neuron (g : gene) : bool := match body_of g with Neuron _ => true | _ => false end.
Definition neurons (genes : list gene) : N := N.of_nat (length (filter is_neuron genes)).
Definition connections (genes : list gene) : N :=
  N.of_nat (length (filter (fun g => negb (is_neuron g)) genes)).

(** ** Which genes make a genome

    [kinds] are those of the neurons so far, the last one first; [joined] the ends of the
    connections so far. *)

Definition may_follow (k : kind) (kinds : list kind) : bool :=
  match k, kinds with
  | Input, [] | Input, Input :: _ | Bias, [] | Bias, Input :: _ | Output, Bias :: _
  | Output, Output :: _ | Hidden, Output :: _ | Hidden, Hidden :: _ => true
  | _, _ => false
  end.

Definition is_output (k : kind) : bool := match k with Output => true | _ => false end.
Definition is_hidden (k : kind) : bool := match k with Hidden => true | _ => false end.
Definition may_be_target (k : kind) : bool := is_output k || is_hidden k.

Definition mark_admitted (l : limits) (stamp : N) (last m : mark) : bool :=
  match mark_compare last m with Lt => true | _ => false end
  && (counter m <? stamp) && (1 <=? counter m)
  && Bool.eqb (maker m =? 0) (counter m <=? genesis_count l).

Fixpoint admitted (l : limits) (stamp : N) (last : mark) (kinds : list kind)
    (joined : list (N * N)) (genes : list gene) : bool :=
  match genes with
  | [] => existsb is_output kinds
  | g :: others =>
      mark_admitted l stamp last (mark_of g) &&
      match body_of g with
      | Neuron k =>
          may_follow k kinds
          && (is_hidden k || (maker (mark_of g) =? 0) && match joined with [] => true | _ => false end)
          && admitted l stamp (mark_of g) (k :: kinds) joined others
      | Connection _ _ source target weight =>
          let known n := n <? N.of_nat (length kinds) in
          existsb is_output kinds && known source && known target
          && may_be_target (nth (N.to_nat target) (rev kinds) Input)
          && negb (existsb (fun ends => (fst ends =? source) && (snd ends =? target)) joined)
          && within weight (weight_max l)
          && admitted l stamp (mark_of g) kinds ((source, target) :: joined) others
      end
  end.

(** The same, without reference to the checks above: inputs, the bias and outputs come first and are
    initial genes, the others are hidden neurons and connections. Neurons are counted from 0, and a
    connection joins two that come before it, the second of which is no input and no bias. *)

Definition initial (k : kind) (g : gene) : Prop := body_of g = Neuron k /\ maker (mark_of g) = 0.
Definition is_connection (g : gene) : Prop :=
  exists enabled recurrent source target weight,
    body_of g = Connection enabled recurrent source target weight.
Definition ends_of (g : gene) : list (N * N) :=
  match body_of g with Connection _ _ source target _ => [(source, target)] | Neuron _ => [] end.
Definition weight_within (l : limits) (g : gene) : Prop :=
  match body_of g with
  | Connection _ _ _ _ weight => within weight (weight_max l) = true
  | Neuron _ => True
  end.

Record well_formed (l : limits) (stamp : N) (genes : list gene) : Prop := {
  in_order : sorted (map mark_of genes);
  below_stamp : Forall (fun g => let m := mark_of g in
    1 <= counter m < stamp /\ (maker m = 0 <-> counter m <= genesis_count l)) genes;
  built_up : exists inputs bias outputs later, genes = inputs ++ bias :: outputs ++ later
    /\ Forall (initial Input) inputs /\ initial Bias bias
    /\ Forall (initial Output) outputs /\ outputs <> []
    /\ Forall (fun g => body_of g = Neuron Hidden \/ is_connection g) later
    /\ forall before g after source target, later = before ++ g :: after ->
         ends_of g = [(source, target)] ->
         let known := N.of_nat (length inputs) + 1 + N.of_nat (length outputs) + neurons before in
         source < known /\ N.of_nat (length inputs) + 1 <= target < known;
  joined_once : NoDup (flat_map ends_of genes);
  weights_within : Forall (weight_within l) genes
}.

(** ** Genomes *)

Definition valid_genome (l : limits) (stamp : N) (g : genome) : bool :=
  negb (robot g =? 0)
  && (neurons (genes g) <=? neurons_max l) && (connections (genes g) <=? connections_max l)
  && admitted l stamp before_all [] [] (genes g).

Definition put_genome (g : genome) : list N :=
  put_number (robot g) ++ put_number (birth g)
  ++ put_number (neurons (genes g)) ++ put_number (connections (genes g))
  ++ put_genes before_all (genes g).

Definition get_genome (l : limits) (stamp : N) (input : list N) : option genome :=
  let* (robot, rest) := get_number (2 ^ 32) input in
  let* (birth, rest) := get_number (2 ^ 32) rest in
  let* (n, rest) := get_number (2 ^ 16) rest in
  let* (m, rest) := get_number (2 ^ 16) rest in
  guard (n <=? neurons_max l) && (m <=? connections_max l) in (* before any work on them *)
  let* (genes, rest) := get_genes (N.to_nat (n + m)) before_all rest in
  let g := Genome robot birth genes in
  guard match rest with [] => true | _ => false end && (neurons genes =? n)
        && valid_genome l stamp g in
  Some g.

(** ** Frames *)

Definition version : N := 1.

Definition valid_header (l : limits) (m : message) : bool :=
  negb (sender m =? 0) && (genesis_count l <? stamp m) && within (energy m) (energy_max l).

Definition size (input : list N) : N := N.of_nat (length input).

Definition put_header (m : message) (payload : list N) : list N :=
  [version] ++ put_number (sender m) ++ put_number (stamp m) ++ put_word 4 (energy m)
  ++ put_number (size payload).

(** What a message's fields can hold, whatever the limits. *)
Definition gene_fits (g : gene) : bool :=
  (counter (mark_of g) <? 2 ^ 64) && (maker (mark_of g) <? 2 ^ 32) &&
  match body_of g with
  | Neuron _ => true
  | Connection _ _ source target weight =>
      (source <? 2 ^ 16) && (target <? 2 ^ 16) && (weight <? 2 ^ 32)
  end.
Definition fits (m : message) : bool :=
  (sender m <? 2 ^ 32) && (stamp m <? 2 ^ 64) && (energy m <? 2 ^ 32)
  && (robot (content m) <? 2 ^ 32) && (birth (content m) <? 2 ^ 32)
  && (neurons (genes (content m)) <? 2 ^ 16) && (connections (genes (content m)) <? 2 ^ 16)
  && forallb gene_fits (genes (content m)).

Definition encode (l : limits) (m : message) : option (list N) :=
  guard fits m && valid_header l m && valid_genome l (stamp m) (content m) in
  let payload := put_genome (content m) in
  let before_sum := put_header m payload ++ payload in
  let frame := before_sum ++ put_word 4 (crc32c before_sum) in
  guard (size payload <? 2 ^ 32) && (size frame <=? frame_bytes l) in Some frame.

Definition decode (l : limits) (frame : list N) : option message :=
  guard size frame <=? frame_bytes l in
  let* (v, rest) := get_word 1 frame in
  guard v =? version in
  let* (sender, rest) := get_number (2 ^ 32) rest in
  let* (stamp, rest) := get_number (2 ^ 64) rest in
  let* (energy, rest) := get_word 4 rest in
  let* (length, rest) := get_number (2 ^ 32) rest in
  guard size rest =? length + 4 in
  let payload := firstn (N.to_nat length) rest in
  let* (sum, _) := get_word 4 (skipn (N.to_nat length) rest) in
  guard sum =? crc32c (firstn (List.length frame - 4) frame) in
  let* content := get_genome l stamp payload in
  let m := Message sender stamp energy content in
  guard valid_header l m in Some m.

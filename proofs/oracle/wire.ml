(* The proved decoder behind one more line of the oracle's language:
   wire FRAME_BYTES GENESIS NEURONS CONNECTIONS ENERGY WEIGHT FRAME
   are the limits, floats by their bits, and a frame in hexadecimal after an x. The answer is
   "refused", or the message: sender, stamp, energy, the genome's robot and birth, and its genes. *)
open Proved
open Words

let bytes text =
  if text = "" || text.[0] <> 'x' || String.length text mod 2 = 0 then
    malformed "not x and hexadecimal digits: '%s'" text;
  List.init (String.length text / 2) (fun i ->
      match int_of_string_opt ("0x" ^ String.sub text (1 + (2 * i)) 2) with
      | Some b -> number (string_of_int b)
      | None -> malformed "not hexadecimal: '%s'" text)

let show_kind = function
  | Input -> "input"
  | Bias -> "bias"
  | Output -> "output"
  | Hidden -> "hidden"

let show_gene g =
  let mark = Printf.sprintf "; %s,%s " (show g.mark_of.counter) (show g.mark_of.maker) in
  match g.body_of with
  | Neuron kind -> mark ^ show_kind kind
  | Connection (enabled, recurrent, source, target, weight) ->
      Printf.sprintf "%s%s>%s %s%s%s" mark (show source) (show target) (show weight)
        (if enabled then " enabled" else "")
        (if recurrent then " recurrent" else "")

let answer frame_bytes genesis neurons connections energy weight frame =
  let l =
    { frame_bytes = number frame_bytes; genesis_count0 = number genesis;
      neurons_max = number neurons; connections_max = number connections;
      energy_max = number energy; weight_max = number weight }
  in
  match decode l (bytes frame) with
  | None -> "refused"
  | Some m ->
      let g = m.content in
      Printf.sprintf "message %s %s %s %s %s%s" (show m.sender) (show m.stamp0) (show m.energy)
        (show g.robot0) (show g.birth)
        (String.concat "" (List.map show_gene g.genes0))

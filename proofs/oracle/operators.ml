(* The proved operators on genomes behind three more lines of the oracle's language, and the proved swarm:
   fitter FITNESS FITNESS SIZE SIZE; crossover uniform|listed DRAWS / GENES / GENES, the fitter first;
   distance C1 C2 C3 UNIT sum|mean / GENES / GENES. A gene is one word: its mark, the marks of the
   neurons that it joins, whether it is recurrent and enabled, its weight in units of 1/UNIT, with commas
   between. Draws are digits after an x: 1 for below one half, 2 for below the probability to disable, or
   of those listed 1 for the other parent's gene. Coefficients are fractions.
   swarm MAXIMUM WINDOW GENESIS starts a swarm; grow, mate, tell, take, listen, wait, store, fail ROBOT …
   are its operations. The answer to one is what the robot has then. *)
open Proved
open Words
let fst = Stdlib.fst

let z word =
  if word <> "" && word.[0] = '-' then
    match number (String.sub word 1 (String.length word - 1)) with
    | N0 -> malformed "minus zero"
    | Npos p -> Zneg p
  else match number word with N0 -> Z0 | Npos p -> Zpos p

let positive_number word =
  match number word with Npos p -> p | N0 -> malformed "zero where a positive number is due"

let show_positive p = show (Npos p)
let show_z = function Z0 -> "0" | Zpos p -> show_positive p | Zneg p -> "-" ^ show_positive p

let flag = function
  | "0" -> false
  | "1" -> true
  | word -> malformed "neither 0 nor 1: '%s'" word
let show_flag on = if on then "1" else "0"

let gene word =
  match String.split_on_char ',' word with
  | [ c; r; sc; sr; tc; tr; recurrent; enabled; weight ] ->
      let mark c r = { counter = number c; maker = number r } in
      { innovation = mark c r; source = mark sc sr; target = mark tc tr; recurrent = flag recurrent;
        enabled = flag enabled; weight = z weight }
  | _ -> malformed "not a connection gene: '%s'" word

let show_gene g =
  let mark m = Printf.sprintf "%s,%s" (show m.counter) (show m.maker) in
  Printf.sprintf " %s,%s,%s,%s,%s,%s" (mark g.innovation) (mark g.source) (mark g.target)
    (show_flag g.recurrent) (show_flag g.enabled) (show_z g.weight)

let digits word =
  if word = "" || word.[0] <> 'x' then malformed "not x and digits: '%s'" word;
  List.map
    (function '0' .. '3' as c -> Char.code c - Char.code '0' | c -> malformed "no draw: '%c'" c)
    (List.tl (List.of_seq (String.to_seq word)))

let fraction word =
  match String.split_on_char '/' word with
  | [ numerator; denominator ] -> { qnum = z numerator; qden = positive_number denominator }
  | _ -> malformed "not a fraction: '%s'" word

let rec two_genomes before = function
  | "/" :: rest -> (List.rev_map gene before, List.map gene rest)
  | word :: rest -> two_genomes (word :: before) rest
  | [] -> malformed "two genomes, with / between"

let crossover kind draws genomes =
  let fitter, weaker = two_genomes [] genomes in
  let mark_of g = g.innovation in
  let child =
    match kind with
    | "uniform" ->
        let pairs = List.map (fun d -> (d land 1 <> 0, d land 2 <> 0)) (digits draws) in
        fst (crossover mark_of choose_uniformly reverses_none pairs fitter weaker)
    | "listed" ->
        let from_other = List.map (fun d -> d <> 0) (digits draws) in
        fst (crossover mark_of choose_listed reverses_none from_other fitter weaker)
    | _ -> malformed "no such crossover: '%s'" kind
  in
  "child" ^ String.concat "" (List.map show_gene child)

let distance c1 c2 c3 unit kind genomes =
  let a, b = two_genomes [] genomes in
  let unit = positive_number unit in
  let difference =
    match kind with
    | "sum" -> weight_sum unit
    | "mean" -> weight_mean unit
    | _ -> malformed "neither sum nor mean: '%s'" kind
  in
  let mark_of g = g.innovation in
  let size = max (List.length a) (List.length b) in
  if size = 0 then malformed "no genes";
  let alignment = align mark_of a b in
  let d =
    qred
      (distance mark_of (fraction c1) (fraction c2) (fraction c3)
         (positive_number (string_of_int size)) difference a b)
  in
  Printf.sprintf "distance %d %d %d %s/%s" (of_nat (excess_count alignment))
    (of_nat (disjoint_count alignment))
    (List.length (matches alignment))
    (show_z d.qnum) (show_positive d.qden)

(* ---- The swarm ---- *)

let state = ref None

let show_robot s r =
  let robot = s.world_of.robots r in
  let held = s.held r in
  let newest =
    match List.rev held with
    | [] -> ""
    | g :: _ -> String.concat "" (List.map (fun m -> Printf.sprintf " %s,%s" (show m.counter) (show m.maker)) g)
  in
  Printf.sprintf "%s %s %s | %d messages%s | %d genomes, the last%s" (show robot.memory.next)
    (show robot.stored)
    (match robot.guard with None -> "-" | Some g -> show g.allowance)
    (List.length s.world_of.network)
    (match List.rev s.world_of.network with [] -> "" | m :: _ -> ", the last " ^ show m.stamp)
    (List.length held) newest

let perform r operation =
  match !state with
  | None -> malformed "the swarm comes first"
  | Some (l, s) ->
      let r = number r in
      let s = operate l s (operation r) in
      state := Some (l, s);
      show_robot s r

let rec marks = function
  | [] -> []
  | c :: r :: rest -> let m = { counter = number c; maker = number r } in m :: marks rest
  | [ _ ] -> malformed "a mark is two numbers"

(* The answer to a command's words, if the command is one of these. *)
let answer = function
  | [ "fitter"; f1; f2; n1; n2 ] ->
      Some (if is_first_fitter (z f1) (z f2) (small_number n1) (small_number n2) then "first" else "second")
  | "crossover" :: kind :: draws :: "/" :: genomes -> Some (crossover kind draws genomes)
  | "distance" :: c1 :: c2 :: c3 :: unit :: kind :: "/" :: genomes ->
      Some (distance c1 c2 c3 unit kind genomes)
  | [ "swarm"; maximum; window; genesis ] ->
      ignore (small_number genesis);
      let l = read_limits maximum "0" window genesis in
      state := Some (l, swarm_init l);
      Some "swarm"
  | [ "grow"; r; i; count ] -> Some (perform r (fun r -> AddGenes (r, small_number i, number count)))
  | "mate" :: r :: fitter :: weaker :: left_out ->
      let gone = marks left_out in
      let keep _ m = not (List.exists (mark_eqb m) gone) in
      Some (perform r (fun r -> Recombine (r, small_number fitter, small_number weaker, keep)))
  | [ "tell"; r; i ] -> Some (perform r (fun r -> Broadcast (r, small_number i)))
  | [ "take"; r; k ] -> Some (perform r (fun r -> Deliver (r, small_number k)))
  | [ "listen"; r; k ] -> Some (perform r (fun r -> Listen (r, small_number k)))
  | [ "wait"; r ] -> Some (perform r (fun r -> Wait r))
  | [ "store"; r; value ] -> Some (perform r (fun r -> Store (r, number value)))
  | [ "fail"; r; block; initial; per_cycle; ceiling ] ->
      let policy = { initial = number initial; per_cycle = number per_cycle; ceiling = number ceiling } in
      let anew = { own_block = number block; own_policy = Some policy } in
      Some (perform r (fun r -> Fail (r, anew)))
  | _ -> None

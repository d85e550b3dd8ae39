(* The proved protocol behind a language of lines: for each command an answer, with the robot's next,
   durable and stored counter and how many marks it knows. The commands are those of Protocol.v, and:
   limits MAXIMUM BLOCK WINDOW GENESIS, which starts anew; flush ROBOT, which persists all that is
   reserved; known ROBOT; align GENOME / GENOME; snapshot NEXT DURABLE, which restores a state; and
   wire, see wire.ml. crash ROBOT BLOCK restarts without a gate, crash ROBOT BLOCK ALLOWANCE
   PER_CYCLE CEILING behind one. What is about genomes is in operators.ml. A mark is two words, counter and robot. *)
open Proved
open Words

let rec marks = function
  | [] -> []
  | c :: r :: rest -> let m = { counter = number c; maker = number r } in m :: marks rest
  | [ _ ] -> malformed "a mark is two numbers"

let show_mark m = Printf.sprintf " %s,%s" (show m.counter) (show m.maker)
let show_marks genes = String.concat "" (List.map show_mark genes)

let show_aligned = function
  | Matching (a, _) -> " =" ^ show_mark a
  | Disjoint (First, a) -> " <" ^ show_mark a
  | Disjoint (Second, a) -> " >" ^ show_mark a
  | Excess (First, a) -> " <<" ^ show_mark a
  | Excess (Second, a) -> " >>" ^ show_mark a

let show_refusal = function
  | BeyondMaximum -> "beyond maximum"
  | BeyondWindow -> "beyond window"
  | BeyondAllowance -> "beyond allowance"
  | NotCovered -> "gene not covered"
  | IdentityConflict -> "identity conflict"

let show_answer w s = function
  | Marks (first, n) -> Printf.sprintf "marks %s %s" (show first) (show n)
  | Exhausted -> "exhausted"
  | SentAs k ->
      let m = List.nth w.network (of_nat k) in
      Printf.sprintf "sent %d %s;%s" (of_nat k) (show m.stamp) (show_marks m.genes)
  | NotDurable -> "not durable"
  | Accepted -> "accepted"
  | Refused why -> (  (* a clock without a gate says no more *)
      match s.guard with None -> "refused" | Some _ -> "refused: " ^ show_refusal why)
  | NoMessage -> "no message"
  | Elapsed -> "elapsed"
  | Persisted -> "persisted"
  | OutOfRange -> "out of range"
  | Resumed -> "resumed"
  | NotResumed -> "not resumed"

let state = ref None

let perform r command =
  match !state with
  | None -> malformed "limits come first"
  | Some (l, w) ->
      let r = number r in
      let w, answer = step gene_clocks l w (command r (w.robots r)) in
      let s = w.robots r in
      state := Some (l, w);
      let left = match s.guard with None -> "-" | Some g -> show g.allowance in
      Printf.sprintf "%s | %s %s %s %d %s" (show_answer w s answer) (show s.memory.next)
        (show s.memory.durable) (show s.stored) (List.length s.known) left

let rec split before = function
  | "/" :: after -> (List.rev before, after)
  | word :: after -> split (word :: before) after
  | [] -> malformed "align needs two genomes, with / between"

(* The answer to a command's words. *)
let answer = function
  | [ "limits"; maximum; block; window; genesis ] ->
      ignore (small_number genesis);
      let l = read_limits maximum block window genesis in
      state := Some (l, init l);
      "limits"
  | [ "mint"; r; n ] -> perform r (fun r _ -> Mint (r, number n))
  | "send" :: r :: genes -> perform r (fun r _ -> Send (r, marks genes))
  | [ "receive"; r; k ] -> perform r (fun r _ -> Receive (r, small_number k))
  | [ "overhear"; r; k ] -> perform r (fun r _ -> Overhear (r, small_number k))
  | [ "elapse"; r ] -> perform r (fun r _ -> Elapse r)
  | "inject" :: r :: stamp :: genes ->
      perform r (fun r _ -> Inject (r, { stamp = number stamp; genes = marks genes }))
  | [ "persist"; r; value ] -> perform r (fun r _ -> Persist (r, number value))
  | [ "flush"; r ] -> perform r (fun r s -> Persist (r, s.memory.durable))
  | [ "crash"; r; block ] ->
      perform r (fun r _ -> Crash (r, { own_block = number block; own_policy = None }))
  | [ "crash"; r; block; initial; per_cycle; ceiling ] ->
      let policy = { initial = number initial; per_cycle = number per_cycle; ceiling = number ceiling } in
      perform r (fun r _ -> Crash (r, { own_block = number block; own_policy = Some policy }))
  | [ "snapshot"; next; durable ] -> (
      match !state with
      | None -> malformed "limits come first"
      | Some (l, _) -> (
          match restore l (number next) (number durable) with
          | None -> "no clock"
          | Some c -> Printf.sprintf "clock %s %s" (show c.next) (show c.durable)))
  | [ "known"; r ] -> (
      match !state with
      | None -> malformed "limits come first"
      | Some (_, w) -> "known" ^ show_marks (w.robots (number r)).known)
  | "align" :: genomes ->
      let a, b = split [] genomes in
      let alignment = align (fun m -> m) (marks a) (marks b) in
      "aligned" ^ String.concat "" (List.map show_aligned alignment)
  | [ "wire"; frame_bytes; genesis; neurons; connections; energy; weight; frame ] ->
      Wire.answer frame_bytes genesis neurons connections energy weight frame
  | words -> (
      match Operators.answer words with
      | Some text -> text
      | None -> malformed "no such command: '%s'" (String.concat " " words))

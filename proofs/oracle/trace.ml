(* The proved trace checker over the lines of a trace (docs/trace-format.md).
   The loop in [check] is check_trace, line by line, so that a trace need not fit into memory. *)
open Proved
open Words

let rule_of = function
  | NotNextCounter -> "not-next-counter"
  | MintedBeyondMaximum -> "beyond-maximum"
  | WrongStamp -> "wrong-stamp"
  | SentBeforeStored -> "sent-before-stored"
  | GeneAboveStamp -> "gene-above-stamp"
  | NoSuchMessage -> "no-such-message"
  | NotAdmitted -> "not-admitted"
  | WrongMaximum -> "wrong-maximum"
  | StoredBackwards -> "stored-backwards"
  | WrongRestart -> "wrong-restart"

let robot word =
  let b = bits word in
  if b < 1L || b > 0xffff_ffffL then malformed "not a robot: '%s'" word;
  number word

let entry = function
  | [ "m"; r; first; count ] -> Mints (robot r, number first, number count)
  | [ "s"; r; stamp; newest ] -> Sends (robot r, number stamp, number newest)
  | [ "r"; r; message; next ] -> Receives (robot r, number message, number next)
  | [ "w"; r; value ] -> Stores (robot r, number value)
  | [ "c"; r; next ] -> Restarts (robot r, number next)
  | words -> malformed "no such entry: '%s'" (String.concat " " words)

type reading = Header | Limits | Entries of limits * checker | Ended of int
exception Broken of violation

let read reading line words =
  match reading, words with
  | Header, [ "gene-clocks-trace"; "1" ] -> Limits
  | Header, _ -> malformed "not a trace of version 1"
  | Limits, [ "limits"; maximum; window; genesis ] ->
      Entries (read_limits maximum "0" window genesis, check_init)
  | Limits, _ -> malformed "limits expected"
  | Entries _, [ "end"; entries ] when bits entries = Int64.of_int (line - 3) -> Ended (line - 3)
  | Entries _, "end" :: _ -> malformed "the trace ends with another number of entries"
  | Entries (l, checker), words -> (
      match check_entry l checker (entry words) with
      | Inl checker -> Entries (l, checker)
      | Inr violation -> raise (Broken violation))
  | Ended _, _ -> malformed "something after the end"

type outcome = Whole of int | Violated of violation | Wrong of string

(* The outcome, and the line it was found at. *)
let check lines =
  let reading = ref Header and at = ref 0 in
  try
    for_each_line at lines (fun words -> reading := read !reading !at words);
    incr at;
    match !reading with
    | Ended entries -> (Whole entries, !at)
    | _ -> malformed "cut short: there is no end"
  with
  | Broken violation -> (Violated violation, !at)
  | Malformed why -> (Wrong why, !at)

(* The one line that docs/trace-format.md prescribes. *)
let verdict = function
  | Whole entries, _ -> Printf.sprintf "accepted %d" entries
  | Violated violation, line -> Printf.sprintf "line %d: %s" line (rule_of violation)
  | Wrong _, line -> Printf.sprintf "line %d: malformed" line

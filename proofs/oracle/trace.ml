(* The proved trace checker as a program: a trace (docs/trace-format.md) from standard input; its
   verdict goes to standard output. Ends with 0: accepted, 1: a rule is broken, 2: malformed.
   The loop below is check_trace, line by line, so that a trace need not fit into memory. *)
open Proved
open Words

let rule_of = function
  | NotNextCounter -> "not-next-counter"
  | BeyondMaximum -> "beyond-maximum"
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
      | Inr violation -> Printf.printf "line %d: %s\n" line (rule_of violation); exit 1)
  | Ended _, _ -> malformed "something after the end"

let () =
  let reading = ref Header and at = ref 0 in
  try
    for_each_line (fun line words -> at := line; reading := read !reading line words);
    incr at;
    match !reading with
    | Ended entries -> Printf.printf "accepted %d\n" entries
    | _ -> malformed "cut short"
  with Malformed why ->
    Printf.printf "line %d: malformed\n" !at;
    Printf.eprintf "line %d: %s\n" !at why;
    exit 2

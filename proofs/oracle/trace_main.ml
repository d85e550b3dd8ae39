(* The proved trace checker as a program: a trace (docs/trace-format.md) from standard input, or
   each of the files given. Verdicts go to standard output, what is malformed to standard error.
   Ends with 0: accepted, 1: a rule is broken, 2: malformed.
   The loop in [check] is check_trace, line by line, so that a trace need not fit into memory. *)
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

(* The exit status; prints the verdict after [label]. *)
let check label channel =
  let reading = ref Header and at = ref 0 in
  try
    for_each_line channel (fun line words -> at := line; reading := read !reading line words);
    incr at;
    match !reading with
    | Ended entries -> Printf.printf "%saccepted %d\n" label entries; 0
    | _ -> malformed "cut short: there is no end"
  with
  | Broken violation -> Printf.printf "%sline %d: %s\n" label !at (rule_of violation); 1
  | Malformed why ->
      Printf.printf "%sline %d: malformed\n" label !at;
      Printf.eprintf "%sline %d: %s\n" label !at why;
      2

let () =
  match List.tl (Array.to_list Sys.argv) with
  | [] -> exit (check "" stdin)
  | files ->
      let check_file file =
        let channel = open_in_bin file in
        Fun.protect ~finally:(fun () -> close_in channel) (fun () -> check (file ^ ": ") channel)
      in
      exit (List.fold_left max 0 (List.map check_file files))

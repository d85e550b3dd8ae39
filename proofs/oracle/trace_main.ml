(* The proved trace checker as a program: a trace from standard input, or each of the files given.
   Verdicts go to standard output, what is malformed to standard error.
   Ends with 0: accepted, 1: a rule is broken, 2: malformed. *)
open Trace

let check label channel =
  let outcome = check (Words.lines_of channel) in
  Printf.printf "%s%s\n" label (verdict outcome);
  match outcome with
  | Whole _, _ -> 0
  | Violated _, _ -> 1
  | Wrong why, line -> Printf.eprintf "%sline %d: %s\n" label line why; 2

let () =
  match List.tl (Array.to_list Sys.argv) with
  | [] -> exit (check "" stdin)
  | files ->
      let check_file file =
        let channel = open_in_bin file in
        Fun.protect ~finally:(fun () -> close_in channel) (fun () -> check (file ^ ": ") channel)
      in
      exit (List.fold_left max 0 (List.map check_file files))

(* The proved protocol as a program: a command a line from standard input, an answer a line. *)
open Words

let () =
  let at = ref 0 in
  try
    for_each_line stdin (fun line words -> at := line; print_endline (Protocol.answer words))
  with Malformed why -> Printf.eprintf "line %d: %s\n" !at why; exit 2

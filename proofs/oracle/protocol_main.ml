(* The proved protocol as a program: a command a line from standard input, an answer a line. *)
open Words

let () =
  let at = ref 0 in
  try
    for_each_line at (lines_of stdin) (fun words -> print_endline (Protocol.answer words))
  with Malformed why -> Printf.eprintf "line %d: %s\n" !at why; exit 2

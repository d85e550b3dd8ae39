(* The proved functions inside another program, by way of in_process.c. *)
let () =
  Callback.register "gene_clocks_oracle_answer" (fun line ->
      try Protocol.answer (String.split_on_char ' ' line)
      with Words.Malformed why -> "malformed: " ^ why);
  Callback.register "gene_clocks_oracle_verdict" (fun text ->
      Trace.verdict (Trace.check (Words.lines_of_text text)))

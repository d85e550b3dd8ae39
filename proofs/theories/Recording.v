(** * The trace that a run of the protocol leaves behind *)
From Coq Require Import NArith List.
From GeneClocks Require Import Mark Clock Protocol.
From GeneClocks Require Trace.
Import ListNotations.
Open Scope N_scope.

Definition newest (genes : list mark) : N := fold_right N.max 0 (map counter genes).

(** What one command leaves; a forged message leaves nothing. *)
Definition entries_of (l : limits) (w : world) (c : command) : list Trace.entry :=
  match c, step gene_clocks l w c with
  | Mint r _, (_, Marks first count) => [Trace.Mints r first count]
  | Send r selection, (w', SentAs k) =>
      let genes := filter (knows (robots w r)) selection in
      [Trace.Sends r (next (memory (robots w r))) (newest genes)]
  | Receive r k, (w', Accepted) | Overhear r k, (w', Accepted) =>
      [Trace.Receives r (N.of_nat k) (next (memory (robots w' r)))]
  | Persist r _, (w', Persisted) => [Trace.Stores r (stored (robots w' r))]
  | Crash r _, (w', Resumed) => [Trace.Restarts r (next (memory (robots w' r)))]
  | _, _ => []
  end.

Fixpoint recording_from (l : limits) (w : world) (commands : list command) : list Trace.entry :=
  match commands with
  | [] => []
  | c :: rest => entries_of l w c ++ recording_from l (fst (step gene_clocks l w c)) rest
  end.
Definition recording (l : limits) (commands : list command) : list Trace.entry :=
  recording_from l (init l) commands.

(** * The functions of kernel.h

    Made by c_to_coq from the header; do not edit. *)
From Coq Require Import ZArith String List.
From Refinement Require Import Semantics.
Import ListNotations.
Open Scope string_scope.
Open Scope Z_scope.

Definition gene_clocks_counter : int_type := UInt64.
Definition size_t : int_type := UInt64.

Definition gene_clocks_matching : Z := 0.
Definition gene_clocks_disjoint_first : Z := 1.
Definition gene_clocks_disjoint_second : Z := 2.
Definition gene_clocks_excess_first : Z := 3.
Definition gene_clocks_excess_second : Z := 4.
Definition gene_clocks_admitted : Z := 0.
Definition gene_clocks_beyond_maximum : Z := 1.
Definition gene_clocks_beyond_window : Z := 2.
Definition gene_clocks_beyond_allowance : Z := 3.
Definition gene_clocks_gene_not_covered : Z := 4.
Definition gene_clocks_identity_conflict : Z := 5.

(** Parameters: 0 a, 1 b. *)
Definition gene_clocks_less : function :=
  (Function 2
    (Return
      (Some
        (Convert Bool
          (Choose
            (Binary Unequal UInt64 (Member (Local 0) "counter") (Member (Local 1) "counter"))
            (Binary Less UInt64 (Member (Local 0) "counter") (Member (Local 1) "counter"))
            (Binary Less UInt32 (Member (Local 0) "robot") (Member (Local 1) "robot"))))))).

(** Parameters: 0 a, 1 b. *)
Definition gene_clocks_equal : function :=
  (Function 2
    (Return
      (Some
        (Convert Bool
          (And
            (Binary Equal UInt64 (Member (Local 0) "counter") (Member (Local 1) "counter"))
            (Binary Equal UInt32 (Member (Local 0) "robot") (Member (Local 1) "robot"))))))).

(** Parameters: 0 state, 1 limits, 2 next, 3 durable. *)
Definition gene_clocks_restore : function :=
  (Function 4
    (Sequence
      (If
        (Or
          (Or
            (Binary Equal UInt64 (Local 2) (Convert UInt64 (Constant 0)))
            (Binary More UInt64 (Local 2) (Local 3)))
          (Binary More UInt64 (Local 3) (Member (Load (Local 1)) "maximum")))
        (Return (Some (Convert Bool (Constant 0))))
        Skip)
      (Sequence
        (Store (Local 0) ["next"] (Local 2))
        (Sequence
          (Store (Local 0) ["durable"] (Local 3))
          (Return (Some (Convert Bool (Constant 1)))))))).

(** Parameters: 0 state, 1 limits, 2 genesis_count. *)
Definition gene_clocks_start : function :=
  (Function 3
    (Sequence
      (If
        (Binary AtLeast UInt64 (Local 2) (Member (Load (Local 1)) "maximum"))
        (Return (Some (Convert Bool (Constant 0))))
        Skip)
      (Sequence
        (Declare (Some (Binary Add UInt64 (Local 2) (Convert UInt64 (Constant 1)))))
        (Return (Some (Call "gene_clocks_restore" [(Local 0); (Local 1); (Local 3); (Local 3)])))))).

(** Parameters: 0 state, 1 limits, 2 genesis_count, 3 stored. *)
Definition gene_clocks_restart : function :=
  (Function 4
    (Return
      (Some
        (Convert Bool
          (And
            (Binary More UInt64 (Local 3) (Local 2))
            (Convert Int32
              (Call "gene_clocks_restore" [(Local 0); (Local 1); (Local 3); (Local 3)]))))))).

(** Parameters: 0 state, 1 limits. *)
Definition gene_clocks_reserve : function :=
  (Function 2
    (If
      (Binary More UInt64 (Member (Load (Local 0)) "next") (Member (Load (Local 0)) "durable"))
      (Scope
        (Sequence
          (Declare
            (Some
              (Binary Sub UInt64
                (Member (Load (Local 1)) "maximum")
                (Member (Load (Local 0)) "next"))))
          (Store (Local 0) ["durable"]
            (Choose
              (Binary Less UInt64 (Member (Load (Local 1)) "block") (Local 2))
              (Binary Add UInt64 (Member (Load (Local 0)) "next") (Member (Load (Local 1)) "block"))
              (Member (Load (Local 1)) "maximum")))))
      Skip)).

(** Parameters: 0 state, 1 limits, 2 count, 3 first. *)
Definition gene_clocks_mint : function :=
  (Function 4
    (Sequence
      (If
        (Binary More UInt64 (Local 2)
          (Binary Sub UInt64 (Member (Load (Local 1)) "maximum") (Member (Load (Local 0)) "next")))
        (Return (Some (Convert Bool (Constant 0))))
        Skip)
      (Sequence
        (Store (Local 3) [] (Member (Load (Local 0)) "next"))
        (Sequence
          (Store (Local 0) ["next"] (Binary Add UInt64 (Member (Load (Local 0)) "next") (Local 2)))
          (Sequence
            (Do (Call "gene_clocks_reserve" [(Local 0); (Local 1)]))
            (Return (Some (Convert Bool (Constant 1))))))))).

(** Parameters: 0 state, 1 limits, 2 stamp. *)
Definition gene_clocks_observe : function :=
  (Function 3
    (Sequence
      (If
        (Binary More UInt64 (Local 2) (Member (Load (Local 1)) "maximum"))
        (Return (Some (Convert Bool (Constant 0))))
        Skip)
      (Sequence
        (If
          (Binary More UInt64 (Local 2) (Member (Load (Local 0)) "next"))
          (Sequence
            (If
              (Binary More UInt64
                (Binary Sub UInt64 (Local 2) (Member (Load (Local 0)) "next"))
                (Member (Load (Local 1)) "window"))
              (Return (Some (Convert Bool (Constant 0))))
              Skip)
            (Sequence
              (Store (Local 0) ["next"] (Local 2))
              (Do (Call "gene_clocks_reserve" [(Local 0); (Local 1)]))))
          Skip)
        (Return (Some (Convert Bool (Constant 1))))))).

(** Parameters: 0 stamp, 1 genome, 2 size. *)
Definition gene_clocks_covers : function :=
  (Function 3
    (Sequence
      (Scope
        (Sequence
          (Declare (Some (Convert UInt64 (Constant 0))))
          (Loop
            (Binary Less UInt64 (Local 3) (Local 2))
            (Assign 3 [] (Binary Add UInt64 (Local 3) (Convert UInt64 (Constant 1))))
            (If
              (Binary AtLeast UInt64
                (Member (Load (Element (Local 1) (Local 3))) "counter")
                (Local 0))
              (Return (Some (Convert Bool (Constant 0))))
              Skip))))
      (Return (Some (Convert Bool (Constant 1)))))).

(** Parameters: 0 next, 1 robot, 2 genome, 3 size. *)
Definition gene_clocks_find_unmade : function :=
  (Function 4
    (Sequence
      (Scope
        (Sequence
          (Declare (Some (Convert UInt64 (Constant 0))))
          (Loop
            (Binary Less UInt64 (Local 4) (Local 3))
            (Assign 4 [] (Binary Add UInt64 (Local 4) (Convert UInt64 (Constant 1))))
            (If
              (And
                (Binary Equal UInt32
                  (Member (Load (Element (Local 2) (Local 4))) "robot")
                  (Local 1))
                (Binary AtLeast UInt64
                  (Member (Load (Element (Local 2) (Local 4))) "counter")
                  (Local 0)))
              (Return (Some (Local 4)))
              Skip))))
      (Return (Some (Local 3))))).

(** Parameters: 0 allowance, 1 counters, 2 ceiling. *)
Definition gene_clocks_earn : function :=
  (Function 3
    (Store (Local 0) []
      (Choose
        (Binary Less UInt64 (Local 1) (Binary Sub UInt64 (Local 2) (Load (Local 0))))
        (Binary Add UInt64 (Load (Local 0)) (Local 1))
        (Local 2)))).

(** Parameters: 0 state, 1 limits, 2 allowance, 3 stamp. *)
Definition gene_clocks_admit : function :=
  (Function 4
    (Sequence
      (If
        (Binary More UInt64 (Local 3) (Member (Load (Local 1)) "maximum"))
        (Return (Some (Convert UInt32 (Constant 1))))
        Skip)
      (Sequence
        (Declare
          (Some
            (Choose
              (Binary More UInt64 (Local 3) (Member (Load (Local 0)) "next"))
              (Binary Sub UInt64 (Local 3) (Member (Load (Local 0)) "next"))
              (Convert UInt64 (Constant 0)))))
        (Sequence
          (If
            (Binary More UInt64 (Local 4) (Member (Load (Local 1)) "window"))
            (Return (Some (Convert UInt32 (Constant 2))))
            Skip)
          (Sequence
            (If
              (Binary More UInt64 (Local 4) (Load (Local 2)))
              (Return (Some (Convert UInt32 (Constant 3))))
              Skip)
            (Sequence
              (Store (Local 2) [] (Binary Sub UInt64 (Load (Local 2)) (Local 4)))
              (Sequence
                (Do (Call "gene_clocks_observe" [(Local 0); (Local 1); (Local 3)]))
                (Return (Some (Convert UInt32 (Constant 0))))))))))).

(** Parameters: 0 visit, 1 match, 2 first, 3 second. *)
Definition gene_clocks_visit : function :=
  (Function 4
    (Do
      (CallBack
        (Member (Load (Local 0)) "gene")
        [(Member (Load (Local 0)) "context"); (Local 1); (Local 2); (Local 3)]))).

(** Parameters: 0 first, 1 first_size, 2 second, 3 second_size, 4 visit. *)
Definition gene_clocks_align : function :=
  (Function 5
    (Sequence
      (Declare (Some (Convert UInt64 (Constant 0))))
      (Sequence
        (Declare (Some (Convert UInt64 (Constant 0))))
        (Sequence
          (Loop
            (And (Binary Less UInt64 (Local 5) (Local 1)) (Binary Less UInt64 (Local 6) (Local 3)))
            Skip
            (If
              (Call "gene_clocks_equal"
                [(Load (Element (Local 0) (Local 5))); (Load (Element (Local 2) (Local 6)))])
              (Sequence
                (Do
                  (Call
                    "gene_clocks_visit"
                    [(Local 4); (Convert UInt32 (Constant 0)); (Local 5); (Local 6)]))
                (Sequence
                  (Assign 5 [] (Binary Add UInt64 (Local 5) (Convert UInt64 (Constant 1))))
                  (Assign 6 [] (Binary Add UInt64 (Local 6) (Convert UInt64 (Constant 1))))))
              (If
                (Call "gene_clocks_less"
                  [(Load (Element (Local 0) (Local 5))); (Load (Element (Local 2) (Local 6)))])
                (Sequence
                  (Do
                    (Call
                      "gene_clocks_visit"
                      [(Local 4); (Convert UInt32 (Constant 1)); (Local 5); (Local 6)]))
                  (Assign 5 [] (Binary Add UInt64 (Local 5) (Convert UInt64 (Constant 1)))))
                (Sequence
                  (Do
                    (Call
                      "gene_clocks_visit"
                      [(Local 4); (Convert UInt32 (Constant 2)); (Local 5); (Local 6)]))
                  (Assign 6 [] (Binary Add UInt64 (Local 6) (Convert UInt64 (Constant 1))))))))
          (Sequence
            (Loop
              (Binary Less UInt64 (Local 5) (Local 1))
              (Assign 5 [] (Binary Add UInt64 (Local 5) (Convert UInt64 (Constant 1))))
              (Do
                (Call "gene_clocks_visit"
                  [(Local 4); (Convert UInt32 (Constant 3)); (Local 5); (Local 6)])))
            (Loop
              (Binary Less UInt64 (Local 6) (Local 3))
              (Assign 6 [] (Binary Add UInt64 (Local 6) (Convert UInt64 (Constant 1))))
              (Do
                (Call "gene_clocks_visit"
                  [(Local 4); (Convert UInt32 (Constant 4)); (Local 5); (Local 6)])))))))).

(** A function calls only those that come after it. *)
Definition kernel : program := [
  ("gene_clocks_align", gene_clocks_align);
  ("gene_clocks_visit", gene_clocks_visit);
  ("gene_clocks_admit", gene_clocks_admit);
  ("gene_clocks_earn", gene_clocks_earn);
  ("gene_clocks_find_unmade", gene_clocks_find_unmade);
  ("gene_clocks_covers", gene_clocks_covers);
  ("gene_clocks_observe", gene_clocks_observe);
  ("gene_clocks_mint", gene_clocks_mint);
  ("gene_clocks_reserve", gene_clocks_reserve);
  ("gene_clocks_restart", gene_clocks_restart);
  ("gene_clocks_start", gene_clocks_start);
  ("gene_clocks_restore", gene_clocks_restore);
  ("gene_clocks_equal", gene_clocks_equal);
  ("gene_clocks_less", gene_clocks_less)
].

(** * A small semantics of C

    What a function of the kernel's header does to memory, step by step: the meaning that
    [c_to_coq] gives to clang's typed syntax tree. Conversions and promotions are explicit there,
    so every operator below works on operands of one type.

    [None] means that C (or this semantics) gives no meaning: signed overflow, division by zero, a
    shift too far, a value that does not fit the signed type it is converted to, reading what was
    never written or lies outside every object, falling off the end of a function whose value is
    used. A theorem that a function returns is thus also a theorem that it does nothing undefined.

    Restrictions: an address is that of a whole object (one struct, one scalar, or one element of
    an array); no two objects overlap, and nothing points inside one. No recursion. *)
From Coq Require Import ZArith String List Bool.
Import ListNotations.
Open Scope Z_scope.

(** ** Values *)

Inductive int_type := Bool | Int8 | Int16 | Int32 | Int64 | UInt8 | UInt16 | UInt32 | UInt64.

(** A block and the index of an element in it. *)
Definition address := (N * Z)%type.

Inductive value :=
| Int (z : Z)
| Pointer (a : address)
| Callback (which : N)                       (** a function that the caller brought *)
| Struct (fields : list (string * value))
| Undefined.                                 (** never written; or the result of a void function *)

(** Whether a number counts as true. *)
Definition nonzero (z : Z) : bool := match z with 0 => false | _ => true end.
Definition of_bool (b : bool) : Z := if b then 1 else 0.

(** An unsigned type wraps; a signed one holds what it can, and nothing else has a meaning (C calls
    overflow undefined, and leaves a conversion that does not fit to the implementation). *)
Definition fit (t : int_type) (z : Z) : option Z :=
  let signed greatest := if (- greatest - 1 <=? z) && (z <=? greatest) then Some z else None in
  match t with
  | Bool => Some (of_bool (nonzero z))
  | UInt8 => Some (z mod 256)
  | UInt16 => Some (z mod 65536)
  | UInt32 => Some (z mod 4294967296)
  | UInt64 => Some (z mod 18446744073709551616)
  | Int8 => signed 127
  | Int16 => signed 32767
  | Int32 => signed 2147483647
  | Int64 => signed 9223372036854775807
  end.

Definition greatest (t : int_type) : Z :=
  match t with
  | Bool => 1
  | Int8 => 127 | Int16 => 32767 | Int32 => 2147483647 | Int64 => 9223372036854775807
  | UInt8 => 255 | UInt16 => 65535 | UInt32 => 4294967295 | UInt64 => 18446744073709551615
  end.

Definition width (t : int_type) : Z :=
  match t with
  | Bool => 1
  | Int8 | UInt8 => 8 | Int16 | UInt16 => 16 | Int32 | UInt32 => 32 | Int64 | UInt64 => 64
  end.

(** ** Syntax *)

Inductive unary := Minus | Complement | Not.
Inductive binary :=
| Add | Sub | Mul | Div | Rem | BitAnd | BitOr | BitXor | Shl | Shr
| Less | More | AtMost | AtLeast | Equal | Unequal.

Inductive expression :=
| Constant (z : Z)
| Local (slot : nat)                                     (** a parameter or a local variable *)
| Load (pointer : expression)                            (** the object that is pointed to *)
| Member (struct : expression) (field : string)
| Element (pointer index : expression)                   (** [pointer + index] *)
| Convert (t : int_type) (e : expression)
| Unary (o : unary) (t : int_type) (e : expression)      (** [t]: the type of operand and result *)
| Binary (o : binary) (t : int_type) (a b : expression)  (** [t]: the type of the operands (of a
                                                             shift, the left one) and, unless
                                                             they are compared, of the result *)
| And (a b : expression)
| Or (a b : expression)
| Choose (condition yes no : expression)
| Call (function : string) (arguments : list expression)
| CallBack (function : expression) (arguments : list expression).

Inductive statement :=
| Skip
| Do (e : expression)
| Declare (initial : option expression)                  (** a variable in the next slot *)
| Assign (slot : nat) (path : list string) (e : expression)
| Store (pointer : expression) (path : list string) (e : expression)
| Sequence (a b : statement)
| If (condition : expression) (yes no : statement)
| Loop (condition : expression) (step body : statement)  (** [for (; condition; step) body] *)
| Scope (s : statement)                                  (** what is declared in [s] ends with it *)
| Break
| Continue
| Return (e : option expression).

Record function := Function { arity : nat; body : statement }.

(** A function calls only those that come after it in the list, so there is no recursion. *)
Definition program := list (string * function).

(** ** States *)

Definition memory := address -> option value.

Definition same_address (a b : address) : bool := N.eqb (fst a) (fst b) && Z.eqb (snd a) (snd b).

Definition write (m : memory) (a : address) (v : value) : memory :=
  fun a' => if same_address a a' then Some v else m a'.

Definition offset (a : address) (index : Z) : address := (fst a, snd a + index).

(** Memory, and the calls of the caller's functions so far. *)
Record state := State { memory_of : memory; calls_of : list (N * list value) }.

Definition locals := list value.

Inductive outcome := Normal | Broken | Continued | Returned (v : value).

(** ** Running *)

Definition bind {A B} (o : option A) (f : A -> option B) : option B :=
  match o with Some a => f a | None => None end.
Notation "x <- e ;; f" := (bind e (fun x => f)) (at level 61, e at next level, right associativity).
Notation "' p <- e ;; f" := (bind e (fun x => let 'p := x in f))
  (at level 61, p pattern, e at next level, right associativity).

Definition number (v : value) : option Z := match v with Int z => Some z | _ => None end.
Definition defined (v : value) : option value := match v with Undefined => None | _ => Some v end.

(** Whether a condition holds. *)
Definition truth (v : value) : option bool := z <- number v ;; Some (nonzero z).

Fixpoint field (name : string) (fields : list (string * value)) : option value :=
  match fields with
  | [] => None
  | (n, v) :: rest => if String.eqb n name then defined v else field name rest
  end.

(** The value with the member that [path] leads to replaced. *)
Fixpoint with_field (name : string) (change : value -> option value)
    (fields : list (string * value)) : option (list (string * value)) :=
  match fields with
  | [] => None
  | (n, v) :: rest =>
      if String.eqb n name then v' <- change v ;; Some ((n, v') :: rest)
      else rest' <- with_field name change rest ;; Some ((n, v) :: rest')
  end.
Fixpoint replaced (path : list string) (new old : value) : option value :=
  match path with
  | [] => Some new
  | name :: rest =>
      match old with
      | Struct fields => fs <- with_field name (replaced rest new) fields ;; Some (Struct fs)
      | _ => None
      end
  end.

Definition apply_unary (o : unary) (t : int_type) (z : Z) : option Z :=
  match o with
  | Minus => fit t (- z)
  | Complement => fit t (Z.lnot z)
  | Not => Some (of_bool (negb (nonzero z)))
  end.

Definition apply_binary (o : binary) (t : int_type) (a b : Z) : option Z :=
  match o with
  | Add => fit t (a + b)
  | Sub => fit t (a - b)
  | Mul => fit t (a * b)
  | Div => if b =? 0 then None else fit t (Z.quot a b)
  | Rem => if b =? 0 then None else _ <- fit t (Z.quot a b) ;; fit t (Z.rem a b)
  | BitAnd => fit t (Z.land a b)
  | BitOr => fit t (Z.lor a b)
  | BitXor => fit t (Z.lxor a b)
  | Shl => if (0 <=? b) && (b <? width t) && (0 <=? a) then fit t (Z.shiftl a b) else None
  | Shr => if (0 <=? b) && (b <? width t) && (0 <=? a) then fit t (Z.shiftr a b) else None
  | Less => Some (of_bool (a <? b))
  | More => Some (of_bool (b <? a))
  | AtMost => Some (of_bool (a <=? b))
  | AtLeast => Some (of_bool (b <=? a))
  | Equal => Some (of_bool (a =? b))
  | Unequal => Some (of_bool (negb (a =? b)))
  end.

Definition call_of := string -> list value -> state -> option (value * state).

Section Running.
Context (outside : N -> list value -> memory -> memory)  (** what the caller's functions do *)
        (fuel : nat)                                     (** rounds that a loop may take *)
        (call : call_of).

Fixpoint evaluate (e : expression) (env : locals) (s : state) {struct e} : option (value * state) :=
  let evaluate_all := fix evaluate_all (es : list expression) (s : state) :=
    match es with
    | [] => Some ([], s)
    | e :: rest =>
        '(v, s) <- evaluate e env s ;; '(vs, s) <- evaluate_all rest s ;; Some (v :: vs, s)
    end in
  match e with
  | Constant z => Some (Int z, s)
  | Local slot => v <- nth_error env slot ;; v <- defined v ;; Some (v, s)
  | Load pointer =>
      '(p, s) <- evaluate pointer env s ;;
      match p with
      | Pointer a => v <- memory_of s a ;; v <- defined v ;; Some (v, s)
      | _ => None
      end
  | Member struct name =>
      '(v, s) <- evaluate struct env s ;;
      match v with Struct fields => v <- field name fields ;; Some (v, s) | _ => None end
  | Element pointer index =>
      '(p, s) <- evaluate pointer env s ;; '(i, s) <- evaluate index env s ;;
      match p, i with Pointer a, Int z => Some (Pointer (offset a z), s) | _, _ => None end
  | Convert t e =>
      '(v, s) <- evaluate e env s ;; z <- number v ;; z <- fit t z ;; Some (Int z, s)
  | Unary o t e =>
      '(v, s) <- evaluate e env s ;; z <- number v ;; z <- apply_unary o t z ;; Some (Int z, s)
  | Binary o t a b =>
      '(v, s) <- evaluate a env s ;; x <- number v ;;
      '(v, s) <- evaluate b env s ;; y <- number v ;;
      z <- apply_binary o t x y ;; Some (Int z, s)
  | And a b =>
      '(v, s) <- evaluate a env s ;; x <- truth v ;;
      if x then '(v, s) <- evaluate b env s ;; y <- truth v ;; Some (Int (of_bool y), s)
      else Some (Int 0, s)
  | Or a b =>
      '(v, s) <- evaluate a env s ;; x <- truth v ;;
      if x then Some (Int 1, s)
      else '(v, s) <- evaluate b env s ;; y <- truth v ;; Some (Int (of_bool y), s)
  | Choose condition yes no =>
      '(v, s) <- evaluate condition env s ;; x <- truth v ;;
      if x then evaluate yes env s else evaluate no env s
  | Call function arguments =>
      '(vs, s) <- evaluate_all arguments s ;; call function vs s
  | CallBack function arguments =>
      '(f, s) <- evaluate function env s ;; '(vs, s) <- evaluate_all arguments s ;;
      match f with
      | Callback which =>
          Some (Undefined, State (outside which vs (memory_of s)) (calls_of s ++ [(which, vs)]))
      | _ => None
      end
  end.

(** One round of a loop ends the loop or leads to the next. *)
Inductive progress := Again (env : locals) (s : state) | Done (o : outcome) (env : locals) (s : state).

Fixpoint iterate (rounds : nat) (round : locals -> state -> option progress) (env : locals)
    (s : state) : option (outcome * locals * state) :=
  match rounds with
  | O => None
  | S rounds =>
      match round env s with
      | Some (Again env s) => iterate rounds round env s
      | Some (Done o env s) => Some (o, env, s)
      | None => None
      end
  end.

Fixpoint set_slot (env : locals) (slot : nat) (change : value -> option value) : option locals :=
  match env, slot with
  | v :: rest, O => v <- change v ;; Some (v :: rest)
  | v :: rest, S slot => rest <- set_slot rest slot change ;; Some (v :: rest)
  | [], _ => None
  end.

Fixpoint execute (c : statement) (env : locals) (s : state)
    : option (outcome * locals * state) :=
  match c with
  | Skip => Some (Normal, env, s)
  | Do e => '(_, s) <- evaluate e env s ;; Some (Normal, env, s)
  | Declare None => Some (Normal, env ++ [Undefined], s)
  | Declare (Some e) => '(v, s) <- evaluate e env s ;; Some (Normal, env ++ [v], s)
  | Assign slot path e =>
      '(v, s) <- evaluate e env s ;; env <- set_slot env slot (replaced path v) ;;
      Some (Normal, env, s)
  | Store pointer path e =>
      '(p, s) <- evaluate pointer env s ;; '(v, s) <- evaluate e env s ;;
      match p with
      | Pointer a =>
          old <- memory_of s a ;; new <- replaced path v old ;;
          Some (Normal, env, State (write (memory_of s) a new) (calls_of s))
      | _ => None
      end
  | Sequence a b =>
      '(o, env, s) <- execute a env s ;;
      match o with Normal => execute b env s | _ => Some (o, env, s) end
  | If condition yes no =>
      '(v, s) <- evaluate condition env s ;; x <- truth v ;;
      if x then execute yes env s else execute no env s
  | Loop condition step body =>
      iterate fuel (fun env s =>
        '(v, s) <- evaluate condition env s ;; x <- truth v ;;
        if x then
          '(o, env, s) <- execute body env s ;;
          match o with
          | Normal | Continued =>
              '(_, env, s) <- execute step env s ;; Some (Again env s)
          | Broken => Some (Done Normal env s)
          | Returned v => Some (Done (Returned v) env s)
          end
        else Some (Done Normal env s)) env s
  | Scope inner =>
      '(o, inner_env, s) <- execute inner env s ;; Some (o, firstn (length env) inner_env, s)
  | Break => Some (Broken, env, s)
  | Continue => Some (Continued, env, s)
  | Return None => Some (Returned Undefined, env, s)
  | Return (Some e) => '(v, s) <- evaluate e env s ;; Some (Returned v, env, s)
  end.
End Running.

(** The result of a function; it is [Undefined] where the function ends without one. *)
Fixpoint run (p : program) (outside : N -> list value -> memory -> memory) (fuel : nat)
    (name : string) (arguments : list value) (s : state) : option (value * state) :=
  match p with
  | [] => None
  | (n, f) :: rest =>
      if String.eqb n name then
        if Nat.eqb (length arguments) (arity f) then
          '(o, _, s) <- execute outside fuel (run rest outside fuel) (body f) arguments s ;;
          match o with
          | Returned v => Some (v, s)
          | Normal => Some (Undefined, s)
          | Broken | Continued => None
          end
        else None
      else run rest outside fuel name arguments s
  end.

(** ** What is said of a function

    It ends, after at most [rounds] rounds of each loop, having returned [result], left memory as
    in [m'], and called the caller's functions as [calls] says; and nothing that it did was
    undefined. *)
Definition returns (p : program) (outside : N -> list value -> memory -> memory) (rounds : nat)
    (name : string) (arguments : list value) (m : memory) (result : value) (m' : memory)
    (calls : list (N * list value)) : Prop :=
  forall fuel, (rounds < fuel)%nat -> exists m'',
    run p outside fuel name arguments (State m []) = Some (result, State m'' calls)
    /\ forall a, m'' a = m' a.

(* SPDX-License-Identifier: Apache-2.0 *)
(** * The checker as an OCaml program

    Writes Spec.ml, Checker.ml, Poly.ml, Hit.ml and what they need into the current folder.
    Integers become those of Zarith, under the name [Zint], because a module [Z] of
    the extraction would hide Zarith's; functions on lists become those of OCaml's
    library that do the same, most of them in constant stack; what is not is only used of
    cells and polynomials, which are short.

    Not proved: that these OCaml functions do what the Coq functions do whose place
    they take.  Each is one line below, to be read. *)
Require Import ZArith List Bool.
Require Import ExtrOcamlBasic.
From Noli Require Import Spec Checker Reading Poly Hit.

(** Only 0, 1 and -1 occur as constants; numbers are never taken apart.  Divisors are positive;
    shifts are by numbers that are not negative. *)
Extract Inductive positive => "Zint.t" [ "Zint.no_xI" "Zint.no_xO" "Zint.one" ] "Zint.no_match".
Extract Inductive Z => "Zint.t" [ "Zint.zero" "" "Zint.neg" ] "Zint.no_match".
Extract Inlined Constant Z.add => "Zint.add".
Extract Inlined Constant Z.sub => "Zint.sub".
Extract Inlined Constant Z.mul => "Zint.mul".
Extract Inlined Constant Z.opp => "Zint.neg".
Extract Inlined Constant Z.ltb => "Zint.lt".
Extract Inlined Constant Z.leb => "Zint.leq".
Extract Inlined Constant Z.eqb => "Zint.equal".
Extract Inlined Constant Z.abs => "Zint.abs".
Extract Inlined Constant Z.div => "Zint.fdiv".
Extract Inlined Constant Z.log2 => "Zint.log2".
Extract Inlined Constant Z.sqrt => "Zint.sqrt".
Extract Inlined Constant Z.shiftl => "Zint.shiftl".
Extract Inlined Constant Z.shiftr => "Zint.shiftr".
Extract Inlined Constant place_bits => "Zint.place_bits".
Extract Inlined Constant time_bits => "Zint.time_bits".
Extract Inlined Constant half_bits => "Zint.half_bits".
Extract Inlined Constant d_quick => "Zint.d_quick".
Extract Inlined Constant d_max => "Zint.d_max".
Extract Inlined Constant few => "Zint.few".
Extract Inlined Constant most_place => "Zint.most_place".
Extract Inlined Constant most_direction => "Zint.most_direction".
Extract Inlined Constant repeatedly => "Zint.repeatedly".

(** Words are OCaml's integers, which have 63 bits and are added and multiplied modulo 2^63.  They are never taken apart,
    and made by [to_word] and the operations alone. *)
Extract Inductive word => "int" [ "Zint.no_word" ] "Zint.no_match".
Extract Inlined Constant val => "Zint.of_int".
Extract Inlined Constant to_word => "Zint.to_word".
Extract Inlined Constant word_add => "Zint.word_add".
Extract Inlined Constant word_mul => "Zint.word_mul".
Extract Inlined Constant word_lt => "Zint.word_lt".
Extract Inlined Constant word_zero => "0".
Extract Inlined Constant word_most => "max_int".

(** What is delayed is OCaml's: computed when it is asked for, and then kept.  Functions here have no effect, so when, and how
    often, makes no difference. *)
Extract Inductive delayed => "Lazy.t" [ "Lazy.from_fun" ] "Zint.no_match".
Extract Inlined Constant force => "Lazy.force".

Extract Inlined Constant fst => "fst".
Extract Inlined Constant snd => "snd".
Extract Inlined Constant negb => "not".
Extract Inlined Constant rev_append => "List.rev_append".
Extract Inlined Constant fold_left => "(fun f l a -> List.fold_left f a l)".
Extract Inlined Constant fold_right => "(fun f a l -> List.fold_right f l a)".
Extract Inlined Constant forallb => "List.for_all".
Extract Inlined Constant existsb => "List.exists".
Extract Inlined Constant filter => "List.filter".
Extract Inlined Constant map => "List.map".
Extract Inlined Constant app => "List.append".

Separate Extraction start_read step check_hit.

(* SPDX-License-Identifier: Apache-2.0 *)
(* Zarith's integers under a name that the extraction does not use itself, and OCaml's own as words. *)
include Z

(* What Zarith does of small integers, which are OCaml's own, without a call. *)
let are_small (a : t) (b : t) = Obj.is_int (Obj.repr a) && Obj.is_int (Obj.repr b)
let small (a : t) : int = Obj.magic a
let lt a b = if are_small a b then small a < small b else Z.lt a b
let leq a b = if are_small a b then small a <= small b else Z.leq a b
let equal a b = if are_small a b then small a = small b else Z.equal a b

(* Rounded down: of numbers that are not negative OCaml's own division is. *)
let fdiv a b = if are_small a b && small a >= 0 && small b > 0 then of_int (Stdlib.( / ) (small a) (small b)) else Z.fdiv a b

(* 2^1024, as d_max in Checker.v *)
let d_max = shift_left one 1024

(* As in Checker.v *)
let place_bits = of_int 40
let time_bits = of_int 20
let half_bits = of_int 10
let d_quick = of_int 256
let few = of_int 1024
let most_place = shift_left one 41
let most_direction = of_int 512

(* As Coq has them, of a divisor above 0 and for numbers of bits that are not negative. *)
let log2 n = if sign n > 0 then of_int (Z.log2 n) else zero
let shiftl n bits = shift_left n (to_int bits)
let shiftr n bits = shift_right n (to_int bits)

(* Words: modulo 2^63, from -2^62 on. *)
let () = assert (Sys.int_size = 63)
let to_word n = if fits_int n then to_int n else to_int (signed_extract n 0 63)
let word_add a b = Stdlib.( + ) a b
let word_mul a b = Stdlib.( * ) a b
let word_lt (a : int) b = a < b

(* As in Hit.v: f, applied n times. *)
let rec repeatedly n f x = if sign n <= 0 then x else repeatedly (pred n) f (f x)

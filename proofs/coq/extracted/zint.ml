(* SPDX-License-Identifier: Apache-2.0 *)
(* Zarith's integers under a name that the extraction does not use itself. *)
include Z

(* 2^1024, as d_max in Checker.v *)
let d_max = shift_left one 1024

(* As in Checker.v *)
let place_bits = of_int 40
let time_bits = of_int 20
let d_quick = of_int 256

(* As Coq has them, of a divisor above 0 and for numbers of bits that are not negative. *)
let log2 n = if sign n > 0 then of_int (Z.log2 n) else zero
let shiftl n bits = shift_left n (to_int bits)
let shiftr n bits = shift_right n (to_int bits)

(* As in Hit.v: f, applied n times. *)
let rec repeatedly n f x = if sign n <= 0 then x else repeatedly (pred n) f (f x)

(* SPDX-License-Identifier: Apache-2.0 *)
(* Zarith's integers under a name that the extraction does not use itself. *)
include Z

(* 2^1024, as d_max in Checker.v *)
let d_max = shift_left one 1024

(* As in Hit.v: f, applied n times. *)
let rec repeatedly n f x = if sign n <= 0 then x else repeatedly (pred n) f (f x)

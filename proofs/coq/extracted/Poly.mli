(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Poly.v by build.sh --renew: not to be edited. *)

type poly = Zint.t list

val add : poly -> poly -> poly

val scale : Zint.t -> poly -> poly

val sub : poly -> poly -> poly

val mul : poly -> poly -> poly

val trim : poly -> poly

val blend : Zint.t -> Zint.t -> Zint.t list -> Zint.t list

val forms : Zint.t -> Zint.t -> Zint.t -> poly -> Zint.t list * Zint.t list

val bernstein : Zint.t -> Zint.t -> Zint.t -> poly -> Zint.t list

val nonnegative_on : Zint.t -> Zint.t -> Zint.t -> poly -> bool

val positive_on : Zint.t -> Zint.t -> Zint.t -> poly -> bool

val last_of : Zint.t -> Zint.t list -> Zint.t

val changes_sign : Zint.t -> Zint.t -> Zint.t -> poly -> bool

val cancel :
  Zint.t -> Zint.t -> Zint.t list -> Zint.t list -> Zint.t list option

val reduces : Zint.t list -> Zint.t -> Zint.t list -> Zint.t list -> bool

val divides : poly -> poly -> bool

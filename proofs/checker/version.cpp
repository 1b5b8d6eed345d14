// SPDX-License-Identifier: Apache-2.0
//
// Version and commit, in a file of their own, so that a new commit recompiles only this file.
namespace noli::checker {

extern const char* const version;

#ifdef NOLI_COMMIT
const char* const version = NOLI_VERSION " " NOLI_COMMIT;
#else
const char* const version = "unknown unknown";
#endif

}  // namespace noli::checker

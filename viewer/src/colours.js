// SPDX-License-Identifier: Apache-2.0
//
// Bodies are pale, so that what meets stands out.

export const ground = 0xe9edf3;
export const ink = 0x1c2330;
/** Of the faces of a contact's first and second feature. page.css has the same for its legend. */
export const meeting = [0xd8102a, 0xffa400];
/** Of the features themselves, over their faces. */
export const meetingDark = [0x5c0010, 0x5f3400];
/** Faces of the other listed contacts of the step. */
export const others = 0xe7a3ad;
/** The motion that another one was made from. */
export const given = 0xd9822b;

const bodies = [0x9db8dc, 0xa5cdb4, 0xc3b1dc, 0x9fc8cf, 0xc9c394, 0xb3bccb, 0xcdb8a6, 0xb9d19b];
export const body = (i) => bodies[i % bodies.length];
export const fixedBody = 0xb4bac4;

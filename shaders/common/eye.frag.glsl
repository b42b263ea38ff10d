// SPDX-License-Identifier: MIT
layout(location = 15) flat in int eye;

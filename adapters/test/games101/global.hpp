#pragma once
// Stand-in: the homework's header of constants.

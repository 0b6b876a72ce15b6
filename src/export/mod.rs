//! Files to take away: pictures and posed surfaces.

float lampShare(vec3 at) { return softlyLit(at); }

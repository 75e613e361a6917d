// Where no shadow falls.
float lampShare(vec3 at) { return 1.0; }

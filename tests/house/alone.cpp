// A program made of one library and what that brings along; house.libraries reads how it would be linked.
int main() {}

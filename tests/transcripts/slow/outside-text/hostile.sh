# Files whose names and contents set a colour, the title of the window and the direction of writing, and end a line.
h=$(printf '\033[31m\033]0;t\007\342\200\256\302\2332J\342\200\213')
printf 'mtllib %s.mtl\nusemtl %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' "$h" "$h" > "$h.obj"
printf 'mtllib %s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 %s\n' "$h" "$h" > broken.obj
printf 'mtllib material.mtl\nusemtl %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' "$h" > material.obj
printf 'newmtl %s\nKd 1 1 %s\nmap_Kd %s.png\n' "$h" "$h" "$h" > material.mtl
printf '%s\n%s\n' "$h" "$h" > answers.txt
printf '{"%s": "%s"}' "$h" "$h" > object.json
mkdir -p snapshots
printf -- '---\nsource: %s\n---\nx\n' "$h" > "snapshots/$h
.snap.new"
printf 'read x\nprintf "%%s\\n" "%s"\nprintf "%%s\\n" "%s" >&2\n' "$h" "$h" > program.sh
cat > speaks.sh <<'END'
while read x; do
    case $x in
        HELLO*) echo "RASTERPROOF 1 name=$1 rule=top-left capabilities=coverage" ;;
        *) echo "$1"; echo "$1" >&2 ;;
    esac
done
END

// react-three-fiber. Clicks and hovers of VisiblePoints hit visible points only.
import { Canvas } from "@react-three/fiber";
import { VisiblePoints } from "hidden-point-removal/react-three-fiber";
import { createRoot } from "react-dom/client";

// Two walls of 40 by 40 points, one behind the other.
const walls = Float32Array.from({ length: 9600 }, (_, i) => {
  const point = Math.floor(i / 3);
  return [(point % 40) - 20, (Math.floor(point / 40) % 40) - 20, point < 1600 ? 0 : -20][i % 3];
});

function Page() {
  return (
    <Canvas frameloop="demand" camera={{ position: [0, 0, 60] }}>
      <VisiblePoints filter={{ exponent: 3, onChange: ({ count }) => console.log(`${count} visible`) }}>
        <bufferGeometry>
          <bufferAttribute attach="attributes-position" args={[walls, 3]} />
        </bufferGeometry>
        <pointsMaterial size={0.5} />
      </VisiblePoints>
    </Canvas>
  );
}

createRoot(document.getElementById("root")).render(<Page />); // → 1600 visible
